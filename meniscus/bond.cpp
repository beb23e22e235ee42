#include "meniscus/bond.h"

#include <algorithm>
#include <cmath>

#include "meniscus/predicates.h"
#include "meniscus/profile.h"

namespace meniscus {
namespace {

constexpr double kFarthest = 0.8;  // slide, in sweep lengths: beyond, the band would be squeezed to nothing

// The contour normal as a direction in space, tangent to the liquid.
glm::dvec3 in_space(const glm::dvec2& direction, const glm::dvec3& liquid_normal) {
  const glm::dvec3 d = lifted(direction, 0);
  return glm::normalize(d - glm::dot(d, liquid_normal) * liquid_normal);
}

double dihedral(const Side& side, const glm::dvec3& up) {
  return std::atan2(glm::length(glm::cross(side.solid_normal, up)), glm::dot(side.solid_normal, up));
}

// The direction up + lean in which the solid goes on from the contour: that of a tilted rod's axis, or of a tilted
// box's edges, and straight up on spheres and cones. Least squares of normal . (up + lean) = 0 over the line; only
// across a flat wall.
glm::dvec2 find_lean(const ContactLine& line) {
  glm::dmat2 square(0);
  glm::dvec2 side(0);
  for (std::size_t i = 0; i < line.segments(); ++i) {
    const double length = glm::distance(line.nodes[i].position, line.next(i).position);
    for (const auto& [normal, up] : {std::pair(line.nodes[i].after.solid_normal, line.nodes[i].liquid_normal),
                                     std::pair(line.next(i).before.solid_normal, line.next(i).liquid_normal)}) {
      const glm::dvec2 n = planar(normal);
      square += length * glm::outerProduct(n, n);
      side -= length * glm::dot(normal, up) * n;
    }
  }
  const double least = 1e-6 * (square[0][0] + square[1][1]);
  if (least == 0) return glm::dvec2(0);
  return glm::inverse(square + glm::dmat2(least)) * side;
}

// The node's rise and slide: from where `lean` and `aside` (metres, at the full height) take it, along the contour
// normal to the solid. Returns whether the line had to be pinned here.
bool bond_side(Side& side, const Node& node, const Body& body, double sweep, double height, const glm::dvec2& lean,
               const glm::dvec2& aside) {
  side.rise = 0, side.slide = glm::dvec2(0);
  if (height == 0) return false;
  const glm::dvec3 up = node.liquid_normal, out = in_space(side.direction, up);
  const glm::dvec3 rail = up + lifted(lean, 0);
  const double slant = -glm::dot(side.solid_normal, rail) / std::max(glm::dot(side.solid_normal, out), 1e-3);
  const auto contact = [&](double h) -> std::optional<glm::dvec3> {
    const glm::dvec3 origin = node.position + h * rail + lifted(h / height * aside, 0);
    const double expected = h * slant, reach = std::min(1.5 * std::abs(expected) + std::abs(h), sweep) + 1e-3 * sweep;
    std::optional<glm::dvec3> hit = shoot(body, origin, out, expected, reach);
    const bool beside_joint = aside != glm::dvec2(0);
    if (node.joint || (!hit && beside_joint)) {
      // Off the ends of a slanted edge the ray misses; at a joint that recedes, the edge is what is nearest.
      const std::optional<Nearest> nearest = nearest_at_height(body, origin, up, out, reach);
      if (nearest && (!hit || !nearest->origin_inside)) hit = nearest->position;
    }
    if (hit && glm::distance(*hit, node.position + h * up) > kFarthest * sweep) hit.reset();
    return hit;
  };
  std::optional<glm::dvec3> at = contact(height);
  const bool pinned = !at;
  if (pinned) {
    double held = 0, lost = 1;  // bisection for the edge, in parts of the height
    at = node.position;
    for (int i = 0; i < 50; ++i) {
      const double middle = 0.5 * (held + lost);
      if (const auto hit = contact(middle * height)) {
        held = middle, at = hit;
      } else {
        lost = middle;
      }
    }
    height *= held;
  }
  side.rise = height;
  side.slide = planar(*at - node.position - height * up);
  return pinned;
}

// Calls visit(node, weight) for the nodes from joint `start` on, weights falling from 1 to 0 within `length` or half
// the way to the next joint, whichever is less; no steeper than lets nodes shifted by `shift` at the joint keep their
// order.
template <class Visit>
void fade_from_joint(const ContactLine& line, std::size_t start, bool forward, double length, double shift,
                     Visit visit) {
  const std::size_t n = line.nodes.size();
  std::vector<std::pair<std::size_t, double>> run;  // nodes and their distance from the joint
  double way = 0;
  for (std::size_t at = start, k = 1; k <= n; ++k) {
    if (!line.closed && (forward ? at + 1 == n : at == 0)) break;
    const std::size_t next = forward ? (at + 1) % n : (at + n - 1) % n;
    way += glm::distance(line.nodes[at].position, line.nodes[next].position);
    at = next;
    if (line.nodes[at].joint) {
      length = std::min(length, 0.5 * way);
      break;
    }
    if (way >= 2 * length) break;
    run.emplace_back(at, way);
  }
  const double power = std::clamp(0.9 * length / std::max(shift, 1e-300), 1.0, 2.0);
  for (const auto& [node, distance] : run) {
    if (distance < length) visit(node, std::pow(1 - distance / length, power));
  }
}

}  // namespace

std::optional<glm::dvec3> shoot(const Body& body, const glm::dvec3& origin, const glm::dvec3& direction,
                                double expected, double reach) {
  Box box;
  box.add(origin - reach * direction);
  box.add(origin + reach * direction);
  std::optional<double> best;
  body.tree.overlapping(box.grown(1e-9 * reach), [&](std::uint32_t t) {
    const glm::dvec3 n = body.mesh.area_normal(t);
    const double facing = glm::dot(n, direction);
    if (!(facing > 1e-9 * glm::length(n))) return;
    const double s = glm::dot(body.mesh.corner(t, 0) - origin, n) / facing;
    if (!(std::abs(s) <= reach)) return;
    const glm::dvec3 p = origin + s * direction;
    constexpr double kEdge = -1e-9;  // in parts of the facet
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 a = body.mesh.corner(t, i), b = body.mesh.corner(t, (i + 1) % 3);
      if (glm::dot(glm::cross(b - a, p - a), n) < kEdge * glm::dot(n, n)) return;
    }
    if (!best || std::abs(s - expected) < std::abs(*best - expected)) best = s;
  });
  if (!best) return {};
  return origin + *best * direction;
}

std::optional<Nearest> nearest_at_height(const Body& body, const glm::dvec3& origin, const glm::dvec3& up,
                                         const glm::dvec3& direction, double reach) {
  Box box;
  box.add(origin);
  std::optional<Nearest> best;
  body.tree.overlapping(box.grown(reach), [&](std::uint32_t t) {
    const glm::dvec3 n = body.mesh.area_normal(t);
    if (!(glm::dot(n, direction) > 1e-9 * glm::length(n))) return;
    std::vector<glm::dvec3> ends;  // of the facet's segment in the plane
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 a = body.mesh.corner(t, i), b = body.mesh.corner(t, (i + 1) % 3);
      const double da = glm::dot(a - origin, up), db = glm::dot(b - origin, up);
      if ((da < 0) != (db < 0)) ends.push_back(a + da / (da - db) * (b - a));
    }
    if (ends.size() < 2) return;
    const glm::dvec3 e = ends[1] - ends[0];
    const double square = glm::dot(e, e);
    const double along = square > 0 ? glm::clamp(glm::dot(origin - ends[0], e) / square, 0.0, 1.0) : 0;
    const glm::dvec3 p = ends[0] + along * e;
    const double distance = glm::distance(p, origin);
    if (distance > reach || (best && distance >= glm::distance(best->position, origin))) return;
    best = {p, glm::dot(origin - p, n) < 0};
  });
  return best;
}

void bond(ContactLine& line, const Body& body, const Liquid& liquid, std::vector<std::string>& warnings) {
  const double sweep = sweep_length(liquid);
  const auto height = [&](const Node& node, const Side& side) {
    return rise(liquid, body.contact_angle, dihedral(side, node.liquid_normal));
  };
  double highest = 0;
  for (const Node& node : line.nodes) {
    highest = std::max({highest, std::abs(height(node, node.before)), std::abs(height(node, node.after))});
  }
  if (highest <= 1e-12 * liquid.capillary_length) {
    line.sweep = 0;
    return;
  }
  line.sweep = sweep;

  const std::size_t n = line.nodes.size();
  const glm::dvec2 lean = find_lean(line);
  std::vector<double> heights(n);
  std::vector<glm::dvec2> aside(n, glm::dvec2(0));
  for (std::size_t i = 0; i < n; ++i) heights[i] = height(line.nodes[i], line.nodes[i].contact);
  std::size_t pinned = 0;
  for (std::size_t i = 0; i < n; ++i) {  // joints first: what they do fades along the line
    Node& node = line.nodes[i];
    if (!node.joint) continue;
    const double before = height(node, node.before), after = height(node, node.after);
    heights[i] = 0.5 * (before + after);
    pinned += bond_side(node.contact, node, body, sweep, heights[i], lean, glm::dvec2(0));
    for (Side* side : {&node.before, &node.after}) side->rise = node.contact.rise, side->slide = node.contact.slide;
    for (const bool forward : {false, true}) {
      const Side& side = forward ? node.after : node.before;
      const double step = heights[i] - (forward ? after : before);
      const glm::dvec2 along{side.direction.y, -side.direction.x};
      const glm::dvec2 shift = glm::dot(side.slide - side.rise * lean, along) * along;
      fade_from_joint(line, i, forward, std::max(0.25 * sweep, 3 * glm::length(shift)), glm::length(shift),
                      [&](std::size_t k, double weight) {
                        heights[k] += weight * step;
                        aside[k] += weight * shift;
                      });
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    Node& node = line.nodes[i];
    if (node.joint) continue;
    pinned += bond_side(node.contact, node, body, sweep, heights[i], lean, aside[i]);
    node.before = node.after = node.contact;
  }
  if (pinned > 0) {
    warnings.push_back("solid '" + body.name + "': the contact line is pinned along " +
                       std::to_string((100 * pinned + n - 1) / n) +
                       " % of its length: the solid ends before the meniscus does, or slants too much for it");
  }
}

}  // namespace meniscus

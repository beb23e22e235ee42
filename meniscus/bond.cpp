#include "meniscus/bond.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "meniscus/predicates.h"
#include "meniscus/profile.h"
#include "meniscus/spine.h"

namespace meniscus {
namespace {

constexpr double kFarthest = 0.8;  // slide, in sweep lengths: beyond, the band would be squeezed to nothing

double dihedral(const glm::dvec3& solid_normal, const glm::dvec3& up) {
  return std::atan2(glm::length(glm::cross(solid_normal, up)), glm::dot(solid_normal, up));
}

// How the contact line climbs (or sinks) from one node: the spine says where it would go if the solid went on as a
// whole, rays along the contour normal find the solid beside it. Heights are along `up`.
struct Climb {
  const Node& node;
  const Body& body;
  double sweep, height;
  const Spine& spine;
  glm::dvec3 up, out;
  glm::dvec3 aside;  // at the full height
  bool must_lean;    // the liquid may stand only where the solid's slant asks for this sense of the meniscus

  // Where rays for a part of the height start.
  glm::dvec3 start(double part) const { return node.position + spine.at(part * height, up) + part * aside; }

  // The contact at a part of the height, found from the one at a smaller part.
  std::optional<Hit> contact(double part, const Hit& from, double from_part) const {
    const glm::dvec3 origin = start(part);
    const glm::dvec3 before = start(from_part);
    // As far along the ray as the facet would be if it went on.
    const double was = glm::dot(from.position - before, out);
    const double expected = glm::dot(from.position - origin, from.facet) / std::max(glm::dot(from.facet, out), 1e-3);
    const double step = std::abs((part - from_part) * height);
    const double reach = std::min(1.5 * std::abs(expected) + std::abs(part * height), sweep) + 1e-3 * sweep;
    std::optional<Hit> hit = shoot(body, origin, out, expected, reach);
    const bool beside_joint = aside != glm::dvec3(0);
    if (node.joint || (!hit && beside_joint)) {
      // Off the ends of a slanted edge the ray misses; at a joint that recedes, the edge is what is nearest.
      const std::optional<Nearest> nearest = nearest_at_height(body, origin, up, out, reach);
      if (nearest && (!hit || !nearest->origin_inside)) hit = nearest->hit;
    }
    if (!hit) return {};
    if (glm::distance(hit->position, node.position + part * height * up) > kFarthest * sweep) return {};
    if (!node.joint && !beside_joint) {
      const double is = glm::dot(hit->position - origin, out);
      if (std::abs(is - was) > 2 * step + 1.5 * std::abs(expected - was) + 1e-3 * sweep) return {};  // another part
      if (must_lean && !leans(hit->normal)) return {};
    }
    return hit;
  }

  // Does the solid slant there so that the liquid goes on to rise (to sink, where it sinks)?
  bool leans(const glm::dvec3& solid_normal) const {
    constexpr double kLevel = 0.087;  // 5 degrees: on a solid as good as level nothing climbs
    const double beta = dihedral(solid_normal, up);
    return height > 0 ? beta > std::max(body.contact_angle, kLevel)
                      : beta < std::min(body.contact_angle, glm::pi<double>() - kLevel);
  }
};

// Climbs as far as the solid allows; returns the part of the height.
double climb_from(const Climb& climb, Hit& at) {
  constexpr int kSteps = 8;  // few enough to be quick, enough to stay on the part of the solid where it starts
  double held = 0;
  for (int k = 1; k <= kSteps; ++k) {
    double next = static_cast<double>(k) / kSteps;
    if (const std::optional<Hit> hit = climb.contact(next, at, held)) {
      held = next, at = *hit;
      continue;
    }
    for (int i = 0; i < 24; ++i) {  // bisection for the edge
      const double middle = 0.5 * (held + next);
      if (const std::optional<Hit> hit = climb.contact(middle, at, held)) {
        held = middle, at = *hit;
      } else {
        next = middle;
      }
    }
    break;
  }
  return held;
}

// The node's rise and slide: from where the spine and `aside` (metres, at the full height) take it, along the contour
// normal to the solid. Returns whether the line had to be pinned here.
bool bond_side(Side& side, Node& node, const Body& body, double sweep, double height, const Spine& spine,
               const glm::dvec2& aside) {
  side.rise = 0, side.slide = glm::dvec2(0);
  const glm::dvec3 up = node.liquid_normal;
  Climb climb{
      node, body, sweep, height, spine, up, glm::normalize(tangent_to(up, side.direction)), tangent_to(up, aside),
      false};
  const Hit level{node.position, side.solid_normal, side.solid_normal, node.position};
  Hit at = level;
  double held = height == 0 ? 1 : climb_from(climb, at);
  if (held < 1) {
    climb.must_lean = climb.leans(side.solid_normal);
    at = level, held = climb_from(climb, at);
    node.room *= held;
  }
  if (held * height == 0) {  // chords between the contour's points may leave the facets
    const double reach = 1e-3 * sweep;
    if (const std::optional<Hit> beside = shoot(body, node.position, climb.out, 0, reach)) at = *beside;
  }
  const glm::dvec3 way = at.position - node.position;
  side.rise = held * height;
  side.slide = planar(way - side.rise * up);
  return held < 1;
}

// Calls visit(node, weight) for the nodes from joint `start` on, weights falling from 1 to 0 within `length` or half
// the way to the next joint, whichever is less; no steeper than lets nodes shifted by `shift` at the joint keep their
// order.
template <class Visit>
void fade_from_joint(const ContactLine& line, std::size_t start, bool forward, double length, double shift,
                     Visit visit) {
  std::vector<std::pair<std::size_t, double>> run;  // nodes and their distance from the joint
  walk(line, start, forward, [&](std::size_t node, double way) {
    const bool joint = line.nodes[node].joint;
    if (joint) length = std::min(length, 0.5 * way);
    if (joint || way >= 2 * length) return false;
    run.emplace_back(node, way);
    return true;
  });
  const double power = std::clamp(0.9 * length / std::max(shift, 1e-300), 1.0, 2.0);
  for (const auto& [node, distance] : run) {
    if (distance < length) visit(node, std::pow(1 - distance / length, power));
  }
}

double wanted_rise(const Node& node, const Side& side, const Body& body, const Liquid& liquid) {
  return node.room * rise(liquid, body.contact_angle, dihedral(side.solid_normal, node.liquid_normal), node.curvature);
}

// Bonds every node, with the spine along which the solid is taken to go on. Returns how many are pinned.
std::size_t bond_along(const Spine& spine, ContactLine& line, const Body& body, const Liquid& liquid) {
  const std::size_t n = line.nodes.size();
  const double sweep = sweep_length(liquid);
  std::vector<double> heights(n);
  std::vector<glm::dvec2> aside(n, glm::dvec2(0));
  for (std::size_t i = 0; i < n; ++i) heights[i] = wanted_rise(line.nodes[i], line.nodes[i].contact, body, liquid);
  std::size_t pinned = 0;
  for (std::size_t i = 0; i < n; ++i) {  // joints first: what they do fades along the line
    Node& node = line.nodes[i];
    if (!node.joint) continue;
    const double before = wanted_rise(node, node.before, body, liquid),
                 after = wanted_rise(node, node.after, body, liquid);
    heights[i] = 0.5 * (before + after);
    pinned += bond_side(node.contact, node, body, sweep, heights[i], spine, glm::dvec2(0));
    for (Side* side : {&node.before, &node.after}) side->rise = node.contact.rise, side->slide = node.contact.slide;
    for (const bool forward : {false, true}) {
      const Side& side = forward ? node.after : node.before;
      const double step = heights[i] - (forward ? after : before);
      const glm::dvec2 along{side.direction.y, -side.direction.x};
      const glm::dvec2 rail = planar(spine.at(side.rise, node.liquid_normal) - side.rise * node.liquid_normal);
      const glm::dvec2 shift = glm::dot(side.slide - rail, along) * along;
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
    pinned += bond_side(node.contact, node, body, sweep, heights[i], spine, aside[i]);
    node.before = node.after = node.contact;
  }
  return pinned;
}

// Segments of the raised line that run backward or are as good as gone: where its nodes have not kept their order.
std::size_t count_disorder(const ContactLine& line) {
  constexpr double kLeast = 0.1;
  std::size_t count = 0;
  for (std::size_t i = 0; i < line.segments(); ++i) {
    const Node &a = line.nodes[i], &b = line.next(i);
    const glm::dvec2 was = planar(b.position) - planar(a.position), is = was + b.contact.slide - a.contact.slide;
    count += glm::dot(was, is) < kLeast * glm::dot(was, was);
  }
  return count;
}

}  // namespace

double run_out(const ContactLine& line, const Body& body, const Liquid& liquid) {
  double farthest = 0;
  for (const Node& node : line.nodes) {
    for (const Side* side : {&node.before, &node.after}) {
      const double rise = wanted_rise(node, *side, body, liquid);
      farthest = std::max(farthest, -rise / std::tan(dihedral(side->solid_normal, node.liquid_normal)));
    }
  }
  Box box;
  for (const glm::dvec3& p : body.mesh.points) box.add(p);
  return std::min(farthest, glm::length(planar(box.high - box.low)));
}

std::size_t bond(ContactLine& line, const Body& body, const Liquid& liquid) {
  double lowest = 0, highest = 0;
  for (const Node& node : line.nodes) {
    for (const Side* side : {&node.before, &node.after}) {
      const double rise = wanted_rise(node, *side, body, liquid);
      lowest = std::min(lowest, rise), highest = std::max(highest, rise);
    }
  }
  if (std::max(-lowest, highest) <= 1e-12 * liquid.capillary_length) {
    line.sweep = 0;
    return 0;
  }
  ContactLine upright = line;
  std::size_t pinned = bond_along(Spine(line, body, lowest, highest), line, body, liquid);
  if (const std::size_t disorder = count_disorder(line)) {  // no rod: a tilted ring, say, which curves away too much
    const std::size_t otherwise = bond_along(Spine(), upright, body, liquid);
    if (count_disorder(upright) < disorder) {
      std::copy(upright.nodes.begin(), upright.nodes.end(), line.nodes.begin());  // in place: feet point to them
      pinned = otherwise;
    }
  }
  return pinned;
}

}  // namespace meniscus

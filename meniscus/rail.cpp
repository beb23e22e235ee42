#include "meniscus/rail.h"

#include <algorithm>
#include <cmath>

#include "meniscus/predicates.h"

namespace meniscus {
namespace {

constexpr double kEdge = 0.5;           // cosine between normals on either side of an edge
constexpr double kStraight = 0.999999;  // and along a straight wall

// The solid beside p, which is as good as on it.
std::optional<Hit> beside(const Body& body, const glm::dvec3& p, const glm::dvec3& normal, double reach) {
  const std::optional<Hit> hit = shoot(body, p, normal, 0, reach);
  return hit && glm::dot(hit->normal, normal) > kEdge ? hit : std::nullopt;
}

}  // namespace

Rail find_rail(const Body& body, const Node& node, const glm::dvec3& p, const glm::dvec3& axis, double length) {
  const glm::dvec3 out = lifted(node.contact.direction, 0);
  Rail rail{p, {}, node.before.solid_normal, node.after.solid_normal};
  if (node.joint) {
    rail.start = nearest_on_solid(body, p).position;
    rail.way = glm::cross(rail.before, rail.after);
    if (rail.way.y < 0) rail.way = -rail.way;
    rail.way = glm::normalize(rail.way);
  } else {
    // Where the contact has gone far, the solid may face another way there than at the node.
    const std::optional<Hit> met = beside(body, p, node.contact.solid_normal, length);
    const Hit hit = met ? *met : nearest_on_solid(body, p);
    rail.start = hit.smooth, rail.bulge = hit.smooth - hit.position, rail.before = rail.after = hit.normal;
    const glm::dvec3 n = rail.before;
    const glm::dvec3 along = glm::dot(n, out) * axis - glm::dot(n, axis) * out;
    rail.way = glm::normalize(along - glm::dot(along, n) * n);
  }
  const glm::dvec3 n = glm::normalize(rail.mean());
  const auto solid_at = [&](double slide) {
    return beside(body, rail.start + slide * rail.way, n, 0.5 * std::abs(slide) + 1e-3 * length);
  };
  const auto holds = [&](double slide) {
    return node.joint ? glm::distance(nearest_on_solid(body, rail.start + slide * rail.way).position,
                                      rail.start + slide * rail.way) < 0.05 * std::abs(slide)
                      : solid_at(slide).has_value();
  };
  const auto end = [&](double slide, bool& ends) {
    ends = !holds(slide);
    if (!ends) return slide;
    double held = 0;
    for (int i = 0; i < 24; ++i) {
      const double middle = 0.5 * (held + slide);
      (holds(middle) ? held : slide) = middle;
    }
    return held;
  };
  // As far as it is straight, at least `length`.
  const auto straight_to = [&](double slide) {
    for (int doubled = 0; doubled < 6; ++doubled, slide *= 2) {
      const std::optional<Hit> hit = node.joint ? std::nullopt : solid_at(2 * slide);
      if (!hit || glm::dot(hit->normal, n) < kStraight) break;
      if (glm::distance(hit->position, rail.start + 2 * slide * rail.way) > 1e-3 * length) break;
    }
    return slide;
  };
  rail.high = end(straight_to(length), rail.ends_high), rail.low = end(straight_to(-length), rail.ends_low);
  if (!node.joint) {
    const std::optional<Hit> above = solid_at(rail.high), below = solid_at(rail.low);
    if (above && below && rail.high - rail.low > 1e-3 * length)
      rail.curvature = glm::dot(above->normal - below->normal, rail.way) / (rail.high - rail.low);
  }
  return rail;
}

}  // namespace meniscus

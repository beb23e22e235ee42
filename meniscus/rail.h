// The way on which a contact vertex may slide on its solid.
#pragma once

#include "meniscus/body.h"
#include "meniscus/columns.h"

namespace meniscus {

// From `start` at slide 0, upward for positive ones: a parabola, as curved as the solid, in the plane of the contour
// normal and the way in which the solid goes on as a whole, or the edge of a joint. It stands for the solid between
// `low` and `high` (metres, low <= 0 <= high).
struct Rail {
  glm::dvec3 start, way;     // way: unit, along the solid, upward
  glm::dvec3 before, after;  // the solid's normals on the sides of the contour's ways that end and start here
  glm::dvec3 bulge{0};       // from the solid's facet to `start`, on the smooth surface that the facet stands for
  double curvature = 0;      // of the solid along the way, 1/m: positive on a sphere
  double low = 0, high = 0;
  bool ends_low = false, ends_high = false;  // the solid ends there, or turns away at an edge

  glm::dvec3 at(double slide) const { return start + slide * way - 0.5 * curvature * slide * slide * mean(); }
  glm::dvec3 way_at(double slide) const { return way - curvature * slide * mean(); }
  glm::dvec3 before_at(double slide) const { return before + curvature * slide * way; }
  glm::dvec3 after_at(double slide) const { return after + curvature * slide * way; }
  glm::dvec3 mean() const { return 0.5 * (before + after); }
};

// The rail at the point of the solid beside `p`, for a node; `length` metres either way, farther where the solid is
// straight, or as far as it goes on smoothly. `axis`: in which the solid goes on, upward.
Rail find_rail(const Body& body, const Node& node, const glm::dvec3& p, const glm::dvec3& axis, double length);

}  // namespace meniscus

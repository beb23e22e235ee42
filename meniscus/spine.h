// How a solid goes on as a whole above and below a contour.
#pragma once

#include <vector>

#include "meniscus/body.h"
#include "meniscus/columns.h"

namespace meniscus {

// A strip along a contour: how long, and the solid's normal there.
struct Strip {
  double length;
  glm::dvec3 normal;
};
// How far the solid with these normals leans, per height, so that they are perpendicular to (lean, 1) in the sense of
// least squares; only across a flat wall.
glm::dvec2 find_lean(const std::vector<Strip>& strips);

// How far a solid's cross section is shifted at each height: straight along a rod's axis or a box's edges, bent with a
// bent rod; upright on spheres and cones.
class Spine {
 public:
  Spine() = default;  // upright
  // From the heights 0 at the contour down to `lowest` (below 0) and up to `highest`.
  Spine(const ContactLine& line, const Body& body, double lowest, double highest);

  // The shift to where the solid is at a signed height along `up` (unit).
  glm::dvec3 at(double height, const glm::dvec3& up) const;

 private:
  struct Branch {
    double step = 0;                 // signed height
    std::vector<glm::dvec2> shifts;  // after each step
  };
  static Branch follow(const ContactLine& line, const Body& body, double end);

  Branch below_, above_;
};

}  // namespace meniscus

// For every point of the plane: how far the nearest contact line is and where on it, measured along contour normals.
#pragma once

#include <limits>
#include <vector>

#include "meniscus/columns.h"
#include "meniscus/tree.h"

namespace meniscus {

// The foot of a point x: x = (point of the contact line) + distance * direction. `direction` is interpolated between
// the contour normals of two sides of the line: along a segment, or over the fan at a convex joint.
struct Foot {
  std::size_t line = 0, node = 0;  // a joint, an end, or the first of a segment's two
  const Side *from = nullptr, *to = nullptr;
  double t = 0;    // weight of `to`
  double fan = 0;  // angle between the two sides where they meet in one joint; 0 on a segment
  double distance = std::numeric_limits<double>::infinity();
  glm::dvec2 direction{};

  bool exists() const { return from != nullptr; }
};

class Field {
 public:
  // Keeps a reference to the lines.
  explicit Field(const std::vector<ContactLine>& lines);

  // The nearest foot, among those no farther than `limit`. Points inside solids have none, or that of another solid.
  Foot foot(const glm::dvec2& x, double limit = std::numeric_limits<double>::infinity()) const;
  // Some foot no farther than `limit`, if there is one. Quicker than the nearest.
  Foot any_foot(const glm::dvec2& x, double limit) const;

  // How far one can go from a point of a line along its normal, up to `limit`, before another foot is nearer. Looks at
  // `tries` distances: at one alone it may stand within a solid, where nothing is near.
  double free_length(const glm::dvec2& from, const glm::dvec2& direction, double limit, int tries) const;

 private:
  enum class Kind { segment, fan, end };
  struct Element {
    Kind kind;
    std::size_t line, node;
  };
  Foot foot_on(const Element& element, const glm::dvec2& x) const;

  const std::vector<ContactLine>& lines_;
  std::vector<Element> elements_;
  Tree tree_;
};

// Signed angle from one contour normal to the other; negative at the convex joints of a solid.
double turn_between(const glm::dvec2& from, const glm::dvec2& to);

}  // namespace meniscus

// Areas and centroids of polygons inside the unit square, edge by edge.
#pragma once

#include <glm/glm.hpp>

namespace meniscal::reference {

// What a closed polygon covers of the unit square: the sum over its edges, in order, of what lies between them and the
// square's bottom. Clockwise polygons have positive areas.
class Coverage {
 public:
  void add_edge(glm::dvec2 a, glm::dvec2 b);
  double area() const { return glm::abs(area_); }
  glm::dvec2 centroid() const { return moment_ / area_; }  // where the area is not 0

 private:
  double area_ = 0;
  glm::dvec2 moment_{0};
};

}  // namespace meniscal::reference

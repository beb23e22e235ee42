// Where the surface of a solid cuts the free surface of a liquid: chains of points with both normals (paper,
// section 3.1).
#pragma once

#include <optional>
#include <vector>

#include "meniscus/body.h"
#include "meniscus/warning.h"

namespace meniscus {

struct ContourPoint {
  glm::dvec3 position;
  glm::dvec3 liquid_normal;  // unit, interpolated
  glm::dvec3 before, after;  // unit normals of the solid on the segments that end and start here; they differ at joints
  std::optional<Edge> border;  // the liquid's border edge on which an open contour starts or ends
};

// Seen from above, the liquid lies to the left of the way from each point to the next, the solid to the right.
struct Contour {
  bool closed;
  std::vector<ContourPoint> points;
};

// All contours of bodies[solid] in the liquid's free surface, found with exact predicates: every pair of
// triangles gives one segment or none, its end points are known by the pair (edge, triangle) that makes them, ties are
// shifted away. Contours that end within the liquid or enclose nothing are left out with a warning.
std::vector<Contour> find_contours(const Topology& liquid, const std::vector<std::uint32_t>& surface,
                                   const Tree& surface_tree, const std::vector<Body>& bodies, std::size_t solid,
                                   Warnings& warnings);

}  // namespace meniscus

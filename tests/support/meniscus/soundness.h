// What must hold of a liquid surface with menisci, found by means of its own: nothing here asks the library.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "meniscus/meniscus.h"
#include "meniscus/tree.h"

namespace soundness {

using meniscus::Solid;
using meniscus::Surface;
using meniscus::TriangleMesh;

// Pairs of triangles that meet elsewhere than in common corners and edges, by exact signs.
std::size_t self_intersections(const TriangleMesh& mesh);

// Over the triangles that are not the liquid's own; degrees.
double smallest_new_angle(const TriangleMesh& result, const TriangleMesh& liquid);

// Positions on edges of one triangle that the liquid's own border (in projection) does not explain: where the surface
// meets the solids.
std::set<std::size_t> contact_vertices(const TriangleMesh& result, const TriangleMesh& liquid);

// Triangles arranged for questions along vertical lines and for the nearest point.
class Shell {
 public:
  explicit Shell(const TriangleMesh& mesh);

  // The heights at which the vertical line through (x, z) meets the mesh, and whether each facet there faces up.
  struct Hit {
    double height;
    bool up;
  };
  std::vector<Hit> column(double x, double z) const;
  // How often the mesh goes round p, by the facets above it; signs as if it faced outward.
  int winding(const glm::dvec3& p) const;
  double distance(const glm::dvec3& p) const;
  const meniscus::Box& box() const { return box_; }

 private:
  const TriangleMesh mesh_;
  meniscus::Box box_;
  meniscus::Tree plan_, tree_;
  int outward_ = 1;
};

// Points of the level liquid, some in each cell of a grid, that are covered by the flat result though inside a solid,
// not covered though outside, or covered twice; points nearer than `tolerance` to a solid are not asked.
struct Coverage {
  std::size_t asked = 0, inside = 0, wrong = 0;
  glm::dvec3 example{};
};
Coverage cover(const TriangleMesh& flat_result, const TriangleMesh& liquid, const std::vector<Shell>& solids,
               double tolerance);

// How deep the middles of meniscus triangles lie within solids, at most, beyond what a chord of their size may cut off;
// metres.
double deepest_within(const Surface& surface, const std::vector<Shell>& solids);

}  // namespace soundness

// What must hold of a liquid surface, checked on a half-edge mesh.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "meniscus/mesh.h"

namespace meniscus {

struct Report {
  std::size_t rejected = 0;  // triangles that would make the surface non-manifold or inconsistently oriented
  std::size_t components = 0, boundary_loops = 0;
  long genus = 0;                                             // of all components together
  std::vector<std::pair<std::size_t, std::size_t>> boundary;  // edges of one triangle, as positions of the mesh
  double smallest_angle = 0;                                  // degrees
};

// Topology with positions merged where they are exactly equal.
Report inspect(const TriangleMesh& mesh);

// What goes wrong at edges, found much quicker than a whole report.
struct Seams {
  bool sound = true;  // no two triangles run along one edge in the same direction
  std::vector<std::pair<std::size_t, std::size_t>> boundary;  // as in Report
};
Seams find_seams(const TriangleMesh& mesh);

}  // namespace meniscus

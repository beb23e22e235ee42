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

}  // namespace meniscus

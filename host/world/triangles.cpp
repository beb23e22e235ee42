#include "host/world/triangles.h"

#include <algorithm>

namespace meniscal {

void append(std::vector<WorldTriangle>& triangles, const meniscus::TriangleMesh& mesh, const WorldTriangle& usual,
            const std::vector<std::uint8_t>* meniscus) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    WorldTriangle t = usual;
    for (int k = 0; k < 3; ++k) {
      t.corner[k] = mesh.positions[mesh.triangles[i][k]];
      t.normal[k] = mesh.normals[mesh.triangles[i][k]];
    }
    const glm::dvec3 cross = glm::cross(t.corner[1] - t.corner[0], t.corner[2] - t.corner[0]);
    const double length = glm::length(cross);
    if (!(length > 0)) continue;
    t.geometric = cross / length;
    t.area = length / 2;
    for (glm::dvec3& n : t.normal)
      if (glm::dot(n, t.geometric) < 0) n = -n;
    if (usual.coordinates != 0) t.coordinates += static_cast<std::uint32_t>(i);
    t.meniscus |= meniscus && (*meniscus)[i];
    triangles.push_back(t);
  }
}

double radius_of(const std::vector<WorldTriangle>& triangles) {
  double radius = 0;
  for (const WorldTriangle& t : triangles)
    for (const glm::dvec3& c : t.corner) radius = std::max(radius, glm::length(c));
  return radius;
}

bool is_over(const WorldTriangle& t, const glm::dvec3& point) {
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 from = t.corner[i], to = t.corner[(i + 1) % 3];
    if (glm::dot(glm::cross(to - from, point - from), t.geometric) < 0) return false;
  }
  return true;
}

}  // namespace meniscal

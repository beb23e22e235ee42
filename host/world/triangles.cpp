#include "host/world/triangles.h"

#include <algorithm>
#include <bit>
#include <tuple>
#include <utility>

namespace meniscal {
namespace {

// The corners in their order, from the least.
std::array<glm::dvec3, 3> from_least(std::array<glm::dvec3, 3> corners) {
  const auto less = [](const glm::dvec3& a, const glm::dvec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  };
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end(), less), corners.end());
  return corners;
}

std::uint64_t hash_of(const WorldTriangle& t) {
  std::uint64_t hash = t.material;
  for (const glm::dvec3& c : from_least(t.corner))
    for (int axis = 0; axis < 3; ++axis) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(c[axis] + 0.0)) * 0x9e3779b97f4a7c15;  // -0 and 0 are one place
      hash ^= hash >> 32;
    }
  return hash;
}

bool coincide(const WorldTriangle& a, const WorldTriangle& b) {
  return a.material == b.material && from_least(a.corner) == from_least(b.corner);
}

}  // namespace

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

std::size_t drop_coincident(std::vector<WorldTriangle>& triangles, const std::vector<shared::Surface>& surfaces) {
  std::vector<std::pair<std::uint64_t, std::size_t>> by_hash;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    if (surfaces[triangles[i].material].kind < shared::SPECULAR_DIELECTRIC)
      by_hash.emplace_back(hash_of(triangles[i]), i);
  std::sort(by_hash.begin(), by_hash.end());
  std::vector<bool> drop(triangles.size(), false);
  for (std::size_t i = 0, first = 0; i < by_hash.size(); ++i) {
    if (by_hash[i].first != by_hash[first].first) first = i;
    if (i > first) drop[by_hash[i].second] = coincide(triangles[by_hash[i].second], triangles[by_hash[first].second]);
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    if (!drop[i]) triangles[kept++] = triangles[i];
  const std::size_t dropped = triangles.size() - kept;
  triangles.resize(kept);
  return dropped;
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

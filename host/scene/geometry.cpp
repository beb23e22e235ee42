#include "host/scene/geometry.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace meniscal::gltf {
namespace {

using glm::dvec3;
using meniscus::TriangleMesh;

// Twice the area, along the facet's normal.
dvec3 area_vector(const TriangleMesh& mesh, const glm::uvec3& t) {
  const dvec3 a = mesh.positions[t.x];
  return glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
}

// One number a place: equal positions share it. 0.0 and -0.0 are one place.
std::vector<std::uint32_t> places(const std::vector<dvec3>& positions) {
  std::vector<std::uint32_t> order(positions.size()), place(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    const dvec3 &p = positions[i], &q = positions[j];
    return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
  });
  std::uint32_t count = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (k > 0 && positions[order[k]] != positions[order[k - 1]]) ++count;
    place[order[k]] = count;
  }
  return place;
}

std::size_t drop(TriangleMesh& mesh, auto&& unusable) { return std::erase_if(mesh.triangles, unusable); }

}  // namespace

std::vector<glm::uvec3> triangulate(const std::vector<std::uint32_t>& indices, int mode) {
  constexpr int strip = 5, fan = 6;
  std::vector<glm::uvec3> triangles;
  const std::size_t n = indices.size();
  if (mode == strip) {
    for (std::size_t i = 0; i + 2 < n; ++i)
      triangles.emplace_back(indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]);
  } else if (mode == fan) {
    for (std::size_t i = 0; i + 2 < n; ++i) triangles.emplace_back(indices[i + 1], indices[i + 2], indices[0]);
  } else {
    for (std::size_t i = 0; i + 2 < n; i += 3) triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
  }
  return triangles;
}

std::size_t drop_collapsed(TriangleMesh& mesh) {
  const auto& p = mesh.positions;
  return drop(mesh, [&](const glm::uvec3& t) { return p[t.x] == p[t.y] || p[t.y] == p[t.z] || p[t.z] == p[t.x]; });
}

std::size_t drop_flat(TriangleMesh& mesh) {
  // Negated, so that a NaN from overflow is dropped too.
  return drop(mesh, [&](const glm::uvec3& t) { return !(glm::length(area_vector(mesh, t)) > 0); });
}

bool is_closed(const std::vector<TriangleMesh>& parts) {
  std::vector<dvec3> positions;
  std::vector<glm::uvec3> triangles;
  for (const TriangleMesh& part : parts) {
    const auto base = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), part.positions.begin(), part.positions.end());
    for (const glm::uvec3& t : part.triangles) triangles.push_back(t + base);
  }
  const std::vector<std::uint32_t> place = places(positions);
  // Each edge's upper place, beside those of the edges with the same lower one: few, so that sorting them costs little.
  std::vector<std::uint32_t> first(positions.size() + 2, 0), upper(3 * triangles.size());
  const auto for_each_edge = [&](auto&& visit) {
    for (const glm::uvec3& t : triangles)
      for (int k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax({place[t[k]], place[t[(k + 1) % 3]]});
        visit(low, high);
      }
  };
  for_each_edge([&](std::uint32_t low, std::uint32_t) { ++first[low + 2]; });
  std::partial_sum(first.begin(), first.end(), first.begin());
  for_each_edge([&](std::uint32_t low, std::uint32_t high) { upper[first[low + 1]++] = high; });
  for (std::size_t low = 0; low < positions.size(); ++low) {
    const auto begin = upper.begin() + first[low], end = upper.begin() + first[low + 1];
    std::sort(begin, end);
    for (auto edge = begin, next = edge; edge != end; edge = next) {
      next = std::upper_bound(edge, end, *edge);
      if (next - edge != 2) return false;
    }
  }
  return !upper.empty();
}

TriangleMesh transformed(const TriangleMesh& mesh, const glm::dmat4& to_world) {
  const glm::dmat3 m(to_world);
  // The cofactor matrix is det(m) times the inverse transpose, and exists for singular m as well.
  const glm::dmat3 cofactor(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  const bool mirrors = glm::dot(m[0], cofactor[0]) < 0;
  TriangleMesh result = mesh;
  for (dvec3& p : result.positions) p = dvec3(to_world * glm::dvec4(p, 1));
  for (dvec3& n : result.normals) {
    const dvec3 turned = cofactor * n * (mirrors ? -1.0 : 1.0);
    const double length = glm::length(turned);
    n = length > 0 ? turned / length : dvec3(0);
  }
  if (mirrors)
    for (glm::uvec3& t : result.triangles) std::swap(t.y, t.z);
  return result;
}

void complete_normals(TriangleMesh& mesh) {
  mesh.normals.resize(mesh.positions.size(), dvec3(0));
  TriangleMesh result;
  std::vector<std::uint32_t> moved_to(mesh.positions.size(), ~0u);
  const auto append = [&](const dvec3& position, const dvec3& normal) {
    result.positions.push_back(position);
    result.normals.push_back(normal);
    return static_cast<std::uint32_t>(result.positions.size() - 1);
  };
  for (const glm::uvec3& t : mesh.triangles) {
    const dvec3 facet = glm::normalize(area_vector(mesh, t));
    glm::uvec3 moved;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t vertex = t[k];
      if (mesh.normals[vertex] == dvec3(0)) {
        moved[k] = append(mesh.positions[vertex], facet);
      } else {
        if (moved_to[vertex] == ~0u) moved_to[vertex] = append(mesh.positions[vertex], mesh.normals[vertex]);
        moved[k] = moved_to[vertex];
      }
    }
    result.triangles.push_back(moved);
  }
  mesh = std::move(result);
}

double straying_of_level_normals(const TriangleMesh& mesh) {
  const double nearly_level = std::cos(glm::radians(2.0));
  double smallest_cosine = 1;
  for (const glm::uvec3& t : mesh.triangles) {
    const dvec3 facet = glm::normalize(area_vector(mesh, t));
    if (facet.y < nearly_level) continue;
    for (int k = 0; k < 3; ++k) smallest_cosine = std::min(smallest_cosine, glm::dot(facet, mesh.normals[t[k]]));
  }
  return std::acos(std::clamp(smallest_cosine, -1.0, 1.0));
}

void recompute_upward_normals(TriangleMesh& mesh) {
  const double upward = std::cos(glm::radians(60.0));
  const std::vector<std::uint32_t> place = places(mesh.positions);
  std::vector<dvec3> sum(mesh.positions.size(), dvec3(0));  // by place
  const auto is_upward = [&](const glm::uvec3& t) { return glm::normalize(area_vector(mesh, t)).y > upward; };
  for (const glm::uvec3& t : mesh.triangles) {
    if (!is_upward(t)) continue;
    for (int k = 0; k < 3; ++k) {
      const dvec3 at = mesh.positions[t[k]];
      const dvec3 a = glm::normalize(mesh.positions[t[(k + 1) % 3]] - at);
      const dvec3 b = glm::normalize(mesh.positions[t[(k + 2) % 3]] - at);
      sum[place[t[k]]] += std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0)) * glm::normalize(area_vector(mesh, t));
    }
  }
  constexpr std::uint32_t none = ~0u;
  std::vector<std::uint32_t> top(mesh.positions.size(), none);  // by place: the upward copy of its vertex
  for (glm::uvec3& t : mesh.triangles) {
    if (!is_upward(t)) continue;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t at = place[t[k]];
      if (top[at] == none) {
        top[at] = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.push_back(dvec3(mesh.positions[t[k]]));  // a copy: push_back may move the vector
        mesh.normals.push_back(glm::normalize(sum[at]));
      }
      t[k] = top[at];
    }
  }
  complete_normals(mesh);  // leaves out the vertices that are no longer used
}

}  // namespace meniscal::gltf

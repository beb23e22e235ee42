#include "meniscus/fitted_normals.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace meniscus {
namespace {

using Neighbours = std::vector<std::vector<std::uint32_t>>;

Neighbours find_neighbours(std::size_t count, const std::vector<glm::uvec3>& triangles) {
  Neighbours of(count);
  for (const glm::uvec3& t : triangles) {
    for (int k = 0; k < 3; ++k) of[t[k]].push_back(t[(k + 1) % 3]), of[t[k]].push_back(t[(k + 2) % 3]);
  }
  for (auto& n : of) {
    std::sort(n.begin(), n.end());
    n.erase(std::unique(n.begin(), n.end()), n.end());
  }
  return of;
}

}  // namespace

std::vector<glm::dvec3> fit_normals(const std::vector<glm::dvec3>& positions, const std::vector<glm::uvec3>& triangles,
                                    const std::vector<glm::dvec3>& about) {
  constexpr int kTerms = 5;  // x, y, x^2, x y, y^2
  const Neighbours of = find_neighbours(positions.size(), triangles);
  std::vector<glm::dvec3> result;
  std::vector<std::uint32_t> ring;
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    ring = of[v];
    for (const std::uint32_t n : of[v]) ring.insert(ring.end(), of[n].begin(), of[n].end());
    std::sort(ring.begin(), ring.end());
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    std::erase(ring, v);
    const glm::dvec3 z = about[v];
    const glm::dvec3 x = glm::normalize(glm::cross(std::abs(z.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1), z));
    const glm::dvec3 y = glm::cross(z, x);
    if (ring.size() < kTerms + 1) {
      result.push_back(z);
      continue;
    }
    Eigen::Matrix<double, Eigen::Dynamic, kTerms> terms(ring.size(), kTerms);
    Eigen::VectorXd heights(ring.size());
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const glm::dvec3 way = positions[ring[i]] - positions[v];
      const double a = glm::dot(way, x), b = glm::dot(way, y), weight = 1 / glm::dot(way, way);
      terms.row(i) << weight * a, weight * b, weight * a * a, weight * a * b, weight * b * b;
      heights[i] = weight * glm::dot(way, z);
    }
    const Eigen::Matrix<double, 1, kTerms> scale = terms.colwise().norm();
    terms.array().rowwise() /= scale.array();
    const Eigen::Matrix<double, kTerms, 1> fit =
        terms.colPivHouseholderQr().solve(heights).cwiseQuotient(scale.transpose());
    result.push_back(fit.allFinite() ? glm::normalize(z - fit[0] * x - fit[1] * y) : z);
  }
  return result;
}

}  // namespace meniscus

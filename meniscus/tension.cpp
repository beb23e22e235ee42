#include "meniscus/tension.h"

namespace meniscus {
namespace {

// The matrix of v -> a x v.
glm::dmat3 cross_with(const glm::dvec3& a) { return {{0, a.z, -a.y}, {-a.z, 0, a.x}, {a.y, -a.x, 0}}; }

}  // namespace

glm::dvec3 corner_shares(const glm::dvec3 p[3]) {
  glm::dvec3 cotangents;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 a = p[(i + 1) % 3] - p[i], b = p[(i + 2) % 3] - p[i];
    const double dot = glm::dot(a, b);
    if (dot <= 0) {
      glm::dvec3 shares(0.25);
      shares[i] = 0.5;
      return shares;
    }
    cotangents[i] = dot / glm::length(glm::cross(a, b));
  }
  const double area = 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
  glm::dvec3 shares;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const glm::dvec3 to_j = p[j] - p[i], to_k = p[k] - p[i];
    shares[i] = (cotangents[k] * glm::dot(to_j, to_j) + cotangents[j] * glm::dot(to_k, to_k)) / (8 * area);
  }
  return shares;
}

FacetForces facet_forces(const glm::dvec3 p[3], const glm::dvec3& shares, double capillary_length) {
  const glm::dvec3 opposite[3] = {p[2] - p[1], p[0] - p[2], p[1] - p[0]}, up(0, 1, 0);
  const glm::dvec3 doubled = glm::cross(opposite[2], -opposite[1]);  // twice the area, along the normal
  const double length = glm::length(doubled), unit = 0.5 / (capillary_length * capillary_length);
  FacetForces f;
  f.normal = doubled / length;
  const glm::dmat3 across = (glm::dmat3(1) - glm::outerProduct(f.normal, f.normal)) / length;
  glm::dvec3 growth[3];  // of `length` per displacement of a corner
  for (int j = 0; j < 3; ++j) {
    const glm::dmat3 change = cross_with(opposite[j]);  // of `doubled`
    f.turn[j] = across * change, growth[j] = f.normal * change;
  }
  for (int i = 0; i < 3; ++i) {
    const glm::dmat3 by_normal = -0.5 * cross_with(opposite[i]), by_edge = 0.5 * cross_with(f.normal);
    const double height = unit * shares[i] * p[i].y;
    f.weight[i] = height * length;
    f.on[i] = by_edge * opposite[i] + f.weight[i] * f.normal;
    for (int j = 0; j < 3; ++j) {
      f.weight_change[i][j] = height * growth[j];
      if (i == j) f.weight_change[i][j] += unit * shares[i] * length * up;
      f.change[i][j] =
          by_normal * f.turn[j] + f.weight[i] * f.turn[j] + glm::outerProduct(f.normal, f.weight_change[i][j]);
      if (j != i) f.change[i][j] += (j == (i + 2) % 3 ? 1.0 : -1.0) * by_edge;
    }
  }
  return f;
}

}  // namespace meniscus

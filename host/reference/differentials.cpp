#include "host/reference/differentials.h"

#include <algorithm>
#include <cmath>

#include "host/reference/optics.h"

namespace meniscal::reference {
std::array<glm::dvec3, 2> tangents(const glm::dvec3& n) {
  const glm::dvec3 u = glm::normalize(std::abs(n.x) > 0.6 ? glm::dvec3(n.z, 0, -n.x) : glm::dvec3(0, -n.z, n.y));
  return {u, glm::cross(n, u)};
}

Differential start_differential(const glm::dvec3& facet_normal, const glm::dvec3& direction, double distance) {
  Differential d;
  d.place = tangents(facet_normal);
  for (int i = 0; i < 2; ++i)
    if (std::isfinite(distance)) d.direction[i] = (d.place[i] - direction * glm::dot(direction, d.place[i])) / distance;
  return d;
}

Differential light_differential(const glm::dvec3& light_normal, double extent, const glm::dvec3& direction) {
  Differential d;
  for (int i = 0; const glm::dvec3& along : tangents(light_normal))
    d.direction[i++] = extent * (direction * glm::dot(direction, along) - along);
  return d;
}

std::array<glm::dvec3, 2> normal_differential(const WorldTriangle& t, const Hit& hit, const Differential& d) {
  std::array<glm::dvec3, 2> dn;
  for (int i = 0; i < 2; ++i) {
    // Barycentric weights change along dp by (normal x opposite edge) dp / (2 area).
    glm::dvec3 sum(0), unnormalized(0);
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 &next = t.corner[(k + 1) % 3], &last = t.corner[(k + 2) % 3];
      const glm::dvec3 gradient = glm::cross(t.geometric, last - next) / (2 * t.area);
      sum += glm::dot(gradient, d.place[i]) * t.normal[k];
      unnormalized += glm::dot(gradient, hit.point - next) * t.normal[k];
    }
    dn[i] = (sum - hit.shading * glm::dot(hit.shading, sum)) / glm::length(unnormalized);
  }
  return dn;
}

void reflect(Differential& d, const glm::dvec3& direction, const glm::dvec3& normal,
             const std::array<glm::dvec3, 2>& dn) {
  const double c = -glm::dot(direction, normal);
  for (int i = 0; i < 2; ++i) {
    const double dc = -glm::dot(d.direction[i], normal) - glm::dot(direction, dn[i]);
    d.direction[i] += 2.0 * (dc * normal + c * dn[i]);
  }
}

void refract(Differential& d, const glm::dvec3& direction, const glm::dvec3& normal,
             const std::array<glm::dvec3, 2>& dn, double eta) {
  const double c = -glm::dot(direction, normal), beyond = refracted_cosine(c, eta);
  const double mu = eta * c - beyond;
  for (int i = 0; i < 2; ++i) {
    const double dc = -glm::dot(d.direction[i], normal) - glm::dot(direction, dn[i]);
    const double dmu = (eta - eta * eta * c / beyond) * dc;
    d.direction[i] = eta * d.direction[i] + dmu * normal + mu * dn[i];
  }
}

void transfer(Differential& d, const glm::dvec3& direction, double distance, const glm::dvec3& plane) {
  for (int i = 0; i < 2; ++i) {
    const glm::dvec3 moved = d.place[i] + distance * d.direction[i];
    d.place[i] = moved - glm::dot(plane, moved) / glm::dot(plane, direction) * direction;
  }
}

double spread(const Differential& d) { return glm::length(glm::cross(d.place[0], d.place[1])); }

Footprint make_footprint(std::initializer_list<Reaching> parts, const glm::dvec3& normal, double narrowest,
                         double widest) {
  const auto [u, v] = tangents(normal);
  // Sigma = J J^T in the tangent plane; its eigenvalues are the squared half-widths.
  double a = 0, b = 0, c = 0;
  for (const Reaching& part : parts)
    for (const glm::dvec3& p : part.differential.place) {
      const double x = part.reach * glm::dot(p, u), y = part.reach * glm::dot(p, v);
      a += x * x, b += x * y, c += y * y;
    }
  const double angle = 0.5 * std::atan2(2 * b, a - c), half_gap = std::hypot(0.5 * (a - c), b);
  double wide = std::sqrt(0.5 * (a + c) + half_gap), narrow = std::sqrt(std::max(0.5 * (a + c) - half_gap, 0.0));
  // At grazing incidence derivatives have no bound: the disc is then as wide as it may be.
  if (!std::isfinite(wide)) wide = narrow = widest;
  const glm::dvec3 along = std::cos(angle) * u + std::sin(angle) * v, across = glm::cross(normal, along);
  return {along / std::clamp(wide, narrowest, widest), across / std::clamp(narrow, narrowest, widest)};
}

}  // namespace meniscal::reference

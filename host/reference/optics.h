// Geometric optics at an interface, in double precision, written apart from the shaders' so that one can check the
// other. Directions are unit vectors; `cosine` is the positive cosine between the direction of arrival and the normal.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace meniscal::reference {

// Snell: cosine of the refracted ray, or a negative number at total internal reflection. `eta` = n_arrival / n_beyond.
inline double refracted_cosine(double cosine, double eta) {
  const double squared = 1 - eta * eta * (1 - cosine * cosine);
  return squared < 0 ? -1 : std::sqrt(squared);
}

// Unpolarised Fresnel reflectance in [0, 1]; 1 at total internal reflection.
inline double fresnel_reflectance(double cosine, double eta) {
  const double beyond = refracted_cosine(cosine, eta);
  if (beyond < 0) return 1;
  const double p = (cosine - eta * beyond) / (cosine + eta * beyond);
  const double s = (eta * cosine - beyond) / (eta * cosine + beyond);
  return (p * p + s * s) / 2;
}

// Reflectance of a thin plane-parallel sheet, all orders of inner reflection summed without interference: 2R / (1 + R).
inline double sheet_reflectance(double cosine, double ior) {
  const double once = fresnel_reflectance(cosine, 1 / ior);
  return 2 * once / (1 + once);
}

inline glm::dvec3 reflect(const glm::dvec3& direction, const glm::dvec3& normal) {
  return direction - 2 * glm::dot(direction, normal) * normal;
}

// `normal` on the side of arrival. Must not be called at total internal reflection.
inline glm::dvec3 refract(const glm::dvec3& direction, const glm::dvec3& normal, double eta) {
  const double cosine = -glm::dot(direction, normal);
  return eta * direction + (eta * cosine - refracted_cosine(cosine, eta)) * normal;
}

}  // namespace meniscal::reference

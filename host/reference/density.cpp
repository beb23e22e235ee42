#include "host/reference/density.h"

#include <glm/gtc/constants.hpp>

namespace meniscal::reference {

namespace {

// Half a disc's, in units of its wide half-width: tan(acos(0.8) / 2), so that on a round surface nothing is lost that
// faces nearly as the photon does.
constexpr double thickness = 1.0 / 3;

// (1 - q2 / s)^p, p from 0 for the uniform one to 2 for the biweight, with s = (p + 2) / 4 for a second moment of 1/4.
double disc_kernel(std::uint32_t kernel, double q2) {
  const double power = kernel, s = (power + 2) / 4;
  return q2 < s ? (power + 1) * glm::one_over_pi<double>() / s * std::pow(1 - q2 / s, power) : 0;
}

}  // namespace

PhotonMap::PhotonMap(std::span<const Photon> photons, double widest, std::uint32_t kernel)
    : cell_size_(widest / 4), kernel_(kernel) {
  for (const Photon& p : photons) {
    if (p.end >= shared::END_FIRST) continue;
    // Half-extents along the axes of the ellipse with half-width vectors alpha / alpha^2 and beta / beta^2, and of its
    // thickness.
    const glm::dvec3 a = p.disc.alpha / glm::dot(p.disc.alpha, p.disc.alpha),
                     b = p.disc.beta / glm::dot(p.disc.beta, p.disc.beta);
    const glm::dvec3 normal = glm::normalize(glm::cross(a, b));
    const glm::dvec3 extent = glm::sqrt(a * a + b * b) + thickness * glm::length(a) * glm::abs(normal) + 1e-9 * widest;
    const glm::i64vec3 low(glm::floor((p.position - extent) / cell_size_)),
        high(glm::floor((p.position + extent) / cell_size_));
    for (auto x = low.x; x <= high.x; ++x)
      for (auto y = low.y; y <= high.y; ++y)
        for (auto z = low.z; z <= high.z; ++z) cells_[key({x, y, z})].push_back(&p);
  }
}

// 21 bits an axis: cells a million radii from the origin stay apart.
std::uint64_t PhotonMap::key(const glm::i64vec3& cell) {
  const auto bits = [](std::int64_t c) { return static_cast<std::uint64_t>(c) & 0x1FFFFF; };
  return bits(cell.x) | bits(cell.y) << 21 | bits(cell.z) << 42;
}

std::array<Density, shared::MAPS> PhotonMap::estimate(const glm::dvec3& position, const glm::dvec3& normal,
                                                      const Face* face, const glm::dvec3& albedo,
                                                      double lobe_part) const {
  std::array<Density, shared::MAPS> densities;
  if (cells_.empty()) return densities;
  const auto cell = cells_.find(key(glm::i64vec3(glm::floor(position / cell_size_))));
  if (cell == cells_.end()) return densities;
  for (const Photon* p : cell->second) {
    const glm::dvec3 offset = position - p->position, facing = glm::cross(p->disc.alpha, p->disc.beta);
    const double a = glm::dot(p->disc.alpha, offset), b = glm::dot(p->disc.beta, offset), q2 = a * a + b * b;
    // Photons of another side of the surface, or beyond a corner or step, are another surface's.
    const double height = std::abs(glm::dot(offset, glm::normalize(facing)));
    if (q2 >= 1 || glm::dot(facing, normal) <= 0.8 * glm::length(facing) ||
        height >= thickness / glm::length(p->disc.alpha))
      continue;
    Density& density = densities[p->map];
    const glm::dvec3 irradiance = p->flux * (1 / p->let_through) * (disc_kernel(kernel_, q2) * glm::length(facing));
    density.irradiance += irradiance;
    if (face) density.beyond_lambert += irradiance * beyond_lambert(*face, albedo, -p->arrival, lobe_part);
    ++density.photons;
  }
  return densities;
}

}  // namespace meniscal::reference

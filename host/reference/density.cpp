#include "host/reference/density.h"

#include <glm/gtc/constants.hpp>

namespace meniscal::reference {

PhotonMap::PhotonMap(std::span<const Photon> photons, double radius) : radius_(radius) {
  for (const Photon& p : photons)
    if (p.end < shared::END_FIRST) cells_[key(glm::i64vec3(glm::floor(p.position / (2 * radius))))].push_back(&p);
}

// 21 bits an axis: cells a million radii from the origin stay apart.
std::uint64_t PhotonMap::key(const glm::i64vec3& cell) {
  const auto bits = [](std::int64_t c) { return static_cast<std::uint64_t>(c) & 0x1FFFFF; };
  return bits(cell.x) | bits(cell.y) << 21 | bits(cell.z) << 42;
}

Density PhotonMap::estimate(const glm::dvec3& position, const glm::dvec3& normal) const {
  Density density;
  const glm::i64vec3 base(glm::floor((position - radius_) / (2 * radius_)));
  for (int c = 0; c < 8; ++c) {
    const auto cell = cells_.find(key(base + glm::i64vec3(c & 1, (c >> 1) & 1, c >> 2)));
    if (cell == cells_.end()) continue;
    for (const Photon* p : cell->second) {
      const glm::dvec3 to_photon = p->position - position;
      const double q2 = glm::dot(to_photon, to_photon) / (radius_ * radius_);
      // Photons of another side of the surface, or beyond a corner or step, are another surface's.
      if (q2 >= 1 || glm::dot(p->normal, normal) <= 0.8 || std::abs(glm::dot(to_photon, normal)) >= 0.5 * radius_) continue;
      density.irradiance += p->flux * (3 * glm::one_over_pi<double>() * (1 - q2) * (1 - q2) / (radius_ * radius_));
      ++density.photons;
    }
  }
  return density;
}

}  // namespace meniscal::reference

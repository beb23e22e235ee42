// Irradiance from photons: the specification of shaders/gather.comp.
#pragma once

#include <array>
#include <span>
#include <unordered_map>

#include "host/reference/photons.h"
#include "host/reference/reflection.h"

namespace meniscal::reference {

struct Density {
  glm::dvec3 irradiance{0};
  glm::dvec3 beyond_lambert{0};  // radiance that the outer face reflects beyond Lambert's
  int photons = 0;
};

// Photons of all maps, each in all cells that its disc's surroundings reach.
class PhotonMap {
 public:
  // `widest`: of the discs' half-widths, m. `kernel`: shared::KERNEL_*.
  PhotonMap(std::span<const Photon> photons, double widest, std::uint32_t kernel);
  // By map: sum of flux K(q2) / (product of half-widths) over the discs that hold a point of a surface with this
  // normal. `face`: where it has an outer one, above this albedo, by `lobe_part` of whose lobe light is reflected.
  std::array<Density, shared::MAPS> estimate(const glm::dvec3& position, const glm::dvec3& normal,
                                             const Face* face = nullptr, const glm::dvec3& albedo = glm::dvec3(0),
                                             double lobe_part = 1) const;

 private:
  static std::uint64_t key(const glm::i64vec3& cell);
  double cell_size_;
  std::uint32_t kernel_;
  std::unordered_map<std::uint64_t, std::vector<const Photon*>> cells_;
};

}  // namespace meniscal::reference

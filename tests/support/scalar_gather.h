// The hash grid and the gather as one would write them in plain C++: what shaders/{sort,cells,gather} are measured
// against.
#pragma once

#include <cmath>
#include <vector>

#include "host/passes/photons.h"
#include "shaders/shared/geometry.h"

namespace meniscal::test {

// The level of the grid that a disc belongs to, as in shaders/photons.comp.
inline std::uint32_t level_of(const shared::PhotonDisc& disc, float narrowest) {
  const float half_width = 1 / std::sqrt(std::min(glm::dot(disc.alpha, disc.alpha), glm::dot(disc.beta, disc.beta)));
  std::uint32_t level = 0;
  while (level + 1 < shared::GRID_LEVELS &&
         1.00001f * half_width > 1.00002f * narrowest * static_cast<float>(1u << level))
    ++level;
  return level;
}

// Photons in order of their cells, by counting sort.
class ScalarGrid {
 public:
  ScalarGrid(const std::vector<shared::PhotonEnd>& ends, const std::vector<shared::PhotonDisc>& discs,
             const passes::Grid& grid)
      : narrowest_(static_cast<float>(grid.discs.narrowest)),
        levels_(grid.levels),
        mask_(grid.mask),
        firsts_(grid.cells() + 1) {
    std::vector<std::uint32_t> keys(ends.size(), shared::NO_CELL);
    for (std::size_t i = 0; i < ends.size(); ++i) {
      if (ends[i].end >= shared::END_FIRST) continue;
      const std::uint32_t level = level_of(discs[i], narrowest_);
      const float size = shared::level_cell_size(narrowest_, level);
      keys[i] = shared::cell_key(shared::grid_cell(ends[i].position, size), level, mask_);
      ++firsts_[keys[i] + 1];
    }
    for (std::size_t i = 1; i < firsts_.size(); ++i) firsts_[i] += firsts_[i - 1];
    photons_.resize(firsts_.back());
    std::vector<std::uint32_t> next = firsts_;
    for (std::size_t i = 0; i < ends.size(); ++i)
      if (keys[i] != shared::NO_CELL)
        photons_[next[keys[i]]++] = {ends[i].position, ends[i].flux.x, discs[i].alpha,
                                     ends[i].flux.y,   discs[i].beta,  ends[i].flux.z};
  }

  glm::vec3 irradiance(const glm::vec3& position, const glm::vec3& normal) const {
    glm::vec3 sum(0);
    for (std::uint32_t level = 0; level < levels_; ++level) {
      const float size = shared::level_cell_size(narrowest_, level);
      const glm::ivec3 corner = shared::grid_cell(position - 0.5f * size, size);
      for (int c = 0; c < 8; ++c) {
        const glm::ivec3 cell = corner + glm::ivec3(c & 1, c >> 1 & 1, c >> 2);
        const std::uint32_t key = shared::cell_key(cell, level, mask_);
        for (std::uint32_t i = firsts_[key]; i < firsts_[key + 1]; ++i) {
          const shared::GatheredPhoton& p = photons_[i];
          const glm::vec3 offset = position - p.position;
          const float a = glm::dot(p.alpha, offset);
          if (a * a >= 1) continue;
          const float b = glm::dot(p.beta, offset), q2 = a * a + b * b;
          if (q2 >= 1) continue;
          const glm::vec3 facing = glm::cross(p.alpha, p.beta);
          const float density = glm::length(facing);
          if (glm::dot(facing, normal) <= 0.8f * density || std::abs(glm::dot(offset, normal)) >= 0.25f * size ||
              shared::grid_cell(p.position, size) != cell)
            continue;
          sum += glm::vec3(std::abs(p.flux_r), p.flux_g, p.flux_b) * (shared::disc_kernel(q2) * density);
        }
      }
    }
    return sum;
  }

 private:
  float narrowest_;
  std::uint32_t levels_, mask_;
  std::vector<std::uint32_t> firsts_;
  std::vector<shared::GatheredPhoton> photons_;
};

}  // namespace meniscal::test

// The hash grid and the gather as one would write them in plain C++: what shaders/{cells,gather} are measured
// against.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "host/passes/photons.h"
#include "shaders/shared/geometry.h"

namespace meniscal::test {

// Photons by the cells that their discs reach into, by counting sort.
class ScalarGrid {
 public:
  ScalarGrid(const std::vector<shared::PhotonDisc>& discs, const passes::Grid& grid)
      : discs_(discs),
        narrowest_(static_cast<float>(grid.discs.narrowest)),
        levels_(grid.levels),
        mask_(grid.mask),
        firsts_(grid.cells() + 1) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> entries;  // (key, photon)
    for (std::uint32_t i = 0; i < discs.size(); ++i) {
      const shared::PhotonDisc& d = discs[i];
      if (d.alpha == glm::vec3(0)) continue;
      const std::uint32_t level = shared::disc_level(d.alpha, d.beta, narrowest_, levels_);
      const float size = shared::level_cell_size(narrowest_, level);
      const glm::vec3 extent = shared::disc_extent(d.alpha, d.beta), reach = shared::cell_reach(d.alpha, d.beta, size),
                      facing = glm::cross(d.alpha, d.beta);
      const glm::ivec3 low = shared::grid_cell(d.position - extent, size),
                       high = shared::grid_cell(d.position + extent, size);
      const auto first = static_cast<std::ptrdiff_t>(entries.size());
      for (int z = low.z; z <= high.z; ++z)
        for (int y = low.y; y <= high.y; ++y)
          for (int x = low.x; x <= high.x; ++x) {
            const glm::ivec3 cell(x, y, z);
            if (!shared::disc_meets_cell(size * glm::vec3(cell) - d.position, d.alpha, d.beta, facing, reach)) continue;
            const std::uint32_t key = shared::cell_key(cell, level, mask_);
            if (std::find(entries.begin() + first, entries.end(), std::pair(key, i)) == entries.end())
              entries.push_back({key, i});
          }
    }
    for (const auto& [key, i] : entries) ++firsts_[key + 1];
    for (std::size_t i = 1; i < firsts_.size(); ++i) firsts_[i] += firsts_[i - 1];
    listed_.resize(firsts_.back());
    std::vector<std::uint32_t> next = firsts_;
    for (const auto& [key, i] : entries) listed_[next[key]++] = i;
  }

  glm::vec3 irradiance(const glm::vec3& position, const glm::vec3& normal) const {
    glm::vec3 sum(0);
    for (std::uint32_t level = 0; level < levels_; ++level) {
      const float size = shared::level_cell_size(narrowest_, level);
      const std::uint32_t key = shared::cell_key(shared::grid_cell(position, size), level, mask_);
      for (std::uint32_t i = firsts_[key]; i < firsts_[key + 1]; ++i) {
        const shared::PhotonDisc& p = discs_[listed_[i]];
        const glm::vec3 offset = position - p.position;
        const float a = glm::dot(p.alpha, offset);
        if (a * a >= 1) continue;
        const float b = glm::dot(p.beta, offset), q2 = a * a + b * b;
        if (q2 >= 1) continue;
        const glm::vec3 facing = glm::cross(p.alpha, p.beta);
        const float density = glm::length(facing);
        if (!shared::disc_holds(offset, normal, q2, p.beta, facing, density)) continue;
        sum += glm::vec3(std::abs(p.flux_r), p.flux_g, p.flux_b) *
               (shared::disc_kernel(shared::KERNEL_BIWEIGHT, q2) * density);
      }
    }
    return sum;
  }

 private:
  const std::vector<shared::PhotonDisc>& discs_;
  float narrowest_;
  std::uint32_t levels_, mask_;
  std::vector<std::uint32_t> firsts_, listed_;
};

}  // namespace meniscal::test

// Photons traced to their ends: host side of shaders/photons.comp.
#pragma once

#include "host/passes/batch.h"
#include "host/passes/scene_tables.h"
#include "host/render/settings.h"

namespace meniscal::passes {

// One slot per started photon.
struct PhotonBuffers {
  gpu::Buffer ends, discs, keys;
  PhotonBuffers(const gpu::Device& device, std::size_t capacity);
};

// The hash grid of a map in one pass: cells of several sizes, each photon in the cell of its disc's size that holds its
// centre.
struct Grid {
  Discs discs;
  std::uint32_t levels;  // cell sizes: those of discs.narrowest doubled so many times
  std::uint32_t mask;    // cells of one level - 1
  std::uint32_t digits;  // of shared::SORT_BITS, that keys need

  std::size_t cells() const { return std::size_t(levels) * (mask + 1); }
};
Grid make_grid(std::uint32_t photons, const Discs& discs);
constexpr std::size_t most_cells = std::size_t(shared::GRID_LEVELS) << 17;

class PhotonPass {
 public:
  // `beams`: there will be at the most. Of the settings, the integrator and whether discs are round stay.
  PhotonPass(const gpu::Device& device, const SceneTables& tables, const PhotonBuffers& buffers, std::size_t beams,
             const RenderSettings& settings);
  // Photons first .. first + count of a pass, into the buffers from their beginning on.
  void run(gpu::Commands& commands, const World& world, const RenderSettings& settings, std::uint32_t pass,
           std::uint32_t first, std::uint32_t count, const Grid& grid);

 private:
  gpu::Buffer beams_;
  gpu::ComputePass pass_;
  gpu::BindingSet buffers_;
  Batch batch_;
};

}  // namespace meniscal::passes

// Irradiance at the visible points from the photon maps: host side of shaders/gather.comp.
#pragma once

#include "host/passes/cells.h"
#include "host/passes/pixels.h"

namespace meniscal::passes {

class GatherPass {
 public:
  // `tiles` must outlive the pass, which adds to their samples. `kernel`: shared::KERNEL_*. `global`: the photons are
  // the global map's. `glossy`: outer faces reflect.
  GatherPass(const gpu::Device& device, const PhotonBuffers& photons, const CellsPass& grid,
             const std::vector<PixelTile>& tiles, std::uint32_t kernel, bool global, bool glossy, bool texel);
  // Submits as many rounds as the pixel with the most candidates needs, after what is recorded already.
  // `crop`: that the tiles hold from their beginning on. `lobe_part`: of outer faces' lobes, by which the map is
  // reflected.
  void run(gpu::Commands& commands, const Grid& grid, const Crop& crop, float lobe_part = 1);

 private:
  gpu::Buffer counters_;
  gpu::ComputePass pass_;
  std::string stage_;  // that its dispatches are
  const std::vector<PixelTile>& tiles_;
  std::vector<gpu::BindingSet> buffers_;  // by tile
  Batch batch_;
};

// Elements of the largest table that grid and gather read, for so many photons at once and pixels.
std::size_t largest_table(std::size_t photons, std::size_t pixels);

}  // namespace meniscal::passes

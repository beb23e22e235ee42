// Irradiance at the visible points from one photon map: host side of shaders/gather.comp.
#pragma once

#include "host/passes/cells.h"

namespace meniscal::passes {

class GatherPass {
 public:
  // Adds to PixelSample[] in `samples`.
  GatherPass(const gpu::Device& device, const CellsPass& map, const gpu::Buffer& samples, bool texel);
  // Submits as many rounds as the pixel with the most candidates needs, after what is recorded already.
  void run(gpu::Commands& commands, std::uint32_t pixels, const Grid& grid, double radius, std::uint32_t stream);

 private:
  gpu::Buffer counters_;
  gpu::ComputePass pass_;
  gpu::BindingSet buffers_;
};

}  // namespace meniscal::passes

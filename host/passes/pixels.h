// The pixels of a crop on the GPU, in as many buffers as the device's limits ask for.
#pragma once

#include "host/gpu/buffer.h"
#include "shaders/shared/structs.h"

namespace meniscal::passes {

struct PixelTile {
  std::uint32_t first, count;  // pixels of the crop, row by row
  gpu::Buffer samples;         // PixelSample[count]
};

inline std::vector<PixelTile> make_tiles(const gpu::Device& device, std::size_t pixels) {
  const std::size_t most =
      std::min<std::size_t>(device.limits().max_storage_range / sizeof(shared::PixelSample), 1u << 20);
  std::vector<PixelTile> tiles;
  for (std::size_t first = 0; first < pixels; first += most) {
    const std::size_t count = std::min(most, pixels - first);
    tiles.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count),
                     gpu::Buffer(device, "pixel samples", count * sizeof(shared::PixelSample))});
  }
  return tiles;
}

}  // namespace meniscal::passes

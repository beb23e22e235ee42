// The pixels of a crop on the GPU, in as many buffers as the device's limits ask for.
#pragma once

#include "host/gpu/buffer.h"
#include "shaders/shared/structs.h"

namespace meniscal::passes {

constexpr std::size_t most_tile_pixels = 1u << 20;

struct PixelTile {
  std::uint32_t first, count;  // pixels of the crop, row by row
  std::uint32_t width;         // of a row
  gpu::Buffer samples;         // PixelSample[count]
  gpu::Buffer gloss;           // PixelGloss[count]; none where no outer face reflects
};

// Whole rows of `width` pixels each.
inline std::vector<PixelTile> make_tiles(const gpu::Device& device, std::size_t pixels, std::uint32_t width,
                                         bool glossy) {
  const std::size_t most =
      std::min<std::size_t>(device.limits().max_storage_range / sizeof(shared::PixelSample), most_tile_pixels);
  const std::size_t rows = std::max<std::size_t>(most / width, 1) * width;
  std::vector<PixelTile> tiles;
  for (std::size_t first = 0; first < pixels; first += rows) {
    const std::size_t count = std::min(rows, pixels - first);
    tiles.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count), width,
                     gpu::Buffer(device, "pixel samples", count * sizeof(shared::PixelSample)),
                     gpu::Buffer(device, "pixel gloss", (glossy ? count : 0) * sizeof(shared::PixelGloss))});
  }
  return tiles;
}

}  // namespace meniscal::passes

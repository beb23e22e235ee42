#include "host/passes/gather.h"

#include <algorithm>

#include "shaders/shaders.h"

namespace meniscal::passes {
namespace {

std::vector<gpu::Binding> layout(bool texel) {
  const gpu::Kind storage = gpu::Kind::storage, table = texel ? gpu::Kind::texel : storage;
  return {{0, table}, {1, table}, {2, storage}, {3, storage}, {4, table},
          {5, table}, {6, table}, {7, table},   {8, storage}};
}

// Pixels run in blocks of 8 x 8, whole ones at the edges too.
std::uint32_t invocations(std::uint32_t pixels, std::uint32_t width) {
  const std::uint32_t rows = (pixels + width - 1) / width;
  return (width + 7) / 8 * ((rows + 7) / 8) * 64;
}

}  // namespace

GatherPass::GatherPass(const gpu::Device& device, const PhotonBuffers& photons, const CellsPass& grid,
                       const std::vector<PixelTile>& tiles, std::uint32_t kernel, bool global, bool glossy, bool texel)
    : counters_(device, photons.map + "gather counters", shared::COUNTERS * 4),
      pass_(device, "gather", shader("gather", texel), layout(texel), sizeof(shared::GatherPush),
            {global, glossy, kernel}),
      stage_(photons.map + "gather"),
      tiles_(tiles) {
  for (const PixelTile& tile : tiles)
    buffers_.push_back(pass_.bind({{0, photons.discs, gpu::Format::rgba32ui},
                                   {1, grid.cells, gpu::Format::rg32ui},
                                   {2, tile.samples},
                                   {3, counters_},
                                   {4, grid.listed, gpu::Format::r32ui},
                                   {5, tile.samples, gpu::Format::rgba32ui},
                                   {6, photons.arrivals, gpu::Format::r32ui},
                                   {7, tile.gloss, gpu::Format::rgba32ui},
                                   {8, tile.gloss}}));
}

void GatherPass::run(gpu::Commands& commands, const Grid& grid, const Crop& crop, float lobe_part) {
  shared::GatherPush push{};
  push.narrowest = static_cast<float>(grid.discs.narrowest);
  push.levels = grid.levels;
  push.cell_mask = grid.mask;
  push.lobe_part = lobe_part;
  push.width = crop.width();
  commands.fill(counters_, 0);
  std::uint32_t most = 0;
  while (push.first_candidate <= most) {
    for (std::size_t t = 0; t < tiles_.size() && tiles_[t].first < crop.pixels(); ++t) {
      push.pixels = static_cast<std::uint32_t>(std::min<std::size_t>(tiles_[t].count, crop.pixels() - tiles_[t].first));
      batch_.run(commands, invocations(push.pixels, push.width), [&](std::uint32_t first, std::uint32_t count) {
        push.first = first;
        push.count = count;
        commands.barrier();
        commands.dispatch(pass_, buffers_[t], push, groups_of_64(count), stage_);
      });
    }
    most = counters_.download<std::uint32_t>()[shared::COUNTER_MOST_CANDIDATES];
    push.first_candidate += shared::GATHER_ROUND;
  }
}

std::size_t largest_table(std::size_t photons, std::size_t pixels) {
  constexpr std::size_t texels = sizeof(shared::PixelSample) / 16;
  return std::max(2 * entry_capacity(photons), texels * std::min(pixels, most_tile_pixels));
}

}  // namespace meniscal::passes

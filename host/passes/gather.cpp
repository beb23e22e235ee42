#include "host/passes/gather.h"

#include "shaders/shaders.h"

namespace meniscal::passes {
namespace {

std::vector<gpu::Binding> layout(bool texel) {
  return {{0, texel ? gpu::Kind::texel : gpu::Kind::storage},
          {1, gpu::Kind::storage},
          {2, gpu::Kind::storage},
          {3, gpu::Kind::storage}};
}

}  // namespace

GatherPass::GatherPass(const gpu::Device& device, const CellsPass& map, const gpu::Buffer& samples, bool texel)
    : counters_(device, "gather counters", shared::COUNTERS * 4),
      pass_(device, "gather", shader("gather", texel), layout(texel), sizeof(shared::GatherPush)),
      buffers_(pass_.bind({{0, map.photons, gpu::Format::rgba32ui}, {1, map.cells}, {2, samples}, {3, counters_}})) {}

void GatherPass::run(gpu::Commands& commands, std::uint32_t pixels, const Grid& grid, double radius, std::uint32_t stream) {
  shared::GatherPush push{};
  push.radius = static_cast<float>(radius);
  push.cell_size = grid.cell_size;
  push.cell_mask = grid.mask;
  push.pixels = pixels;
  push.map = stream;
  commands.fill(counters_, 0);
  std::uint32_t most = 0;
  while (push.first_candidate <= most) {
    commands.barrier();
    commands.dispatch(pass_, buffers_, push, groups_of_64(pixels));
    commands.submit_and_wait();
    most = counters_.download<std::uint32_t>()[shared::COUNTER_MOST_CANDIDATES];
    push.first_candidate += shared::GATHER_ROUND;
  }
}

}  // namespace meniscal::passes

#include "host/passes/cells.h"

#include "shaders/shaders.h"

namespace meniscal::passes {
namespace {

std::vector<gpu::Binding> layout(bool texel) {
  const gpu::Kind table = texel ? gpu::Kind::texel : gpu::Kind::storage;
  return {{0, gpu::Kind::storage}, {1, gpu::Kind::storage}, {2, table}, {3, table},
          {4, gpu::Kind::storage}, {5, gpu::Kind::storage}};
}

}  // namespace

CellsPass::CellsPass(const gpu::Device& device, const PhotonBuffers& unsorted, const SortPass& sort,
                     std::size_t capacity, std::size_t cell_capacity, bool texel)
    : photons(device, "photon map", capacity * sizeof(shared::GatheredPhoton)),
      cells(device, "grid cells", cell_capacity * 8),
      pass_(device, "cells", shader("cells", texel), layout(texel), sizeof(shared::SortPush)),
      even_(pass_.bind({{0, *sort.sorted(0).keys},
                        {1, *sort.sorted(0).values},
                        {2, unsorted.ends, gpu::Format::rgba32ui},
                        {3, unsorted.discs, gpu::Format::rgba32ui},
                        {4, photons},
                        {5, cells}})),
      odd_(pass_.bind({{0, *sort.sorted(1).keys},
                       {1, *sort.sorted(1).values},
                       {2, unsorted.ends, gpu::Format::rgba32ui},
                       {3, unsorted.discs, gpu::Format::rgba32ui},
                       {4, photons},
                       {5, cells}})) {}

void CellsPass::record(gpu::Commands& commands, std::uint32_t count, std::uint32_t digits) {
  commands.fill(cells, 0);
  commands.barrier();
  commands.dispatch(pass_, digits % 2 == 0 ? even_ : odd_, shared::SortPush{count, 0, 0, 0}, groups_of_64(count));
  commands.barrier();
}

}  // namespace meniscal::passes

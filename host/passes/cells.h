// The hash grid of one map, by a stable radix sort: host side of shaders/cells.comp.
#pragma once

#include "host/passes/batch.h"
#include "host/passes/photons.h"

namespace meniscal::passes {

class CellsPass {
 public:
  gpu::Buffer photons;  // GatheredPhoton[], in order of their cells, then of their slots
  gpu::Buffer cells;    // (first, one past the last) by key

  // For up to `capacity` photons, whose keys are NO_CELL or below `cell_capacity`. `texel`: they are read through texel
  // buffers.
  CellsPass(const gpu::Device& device, const PhotonBuffers& unsorted, std::size_t capacity, std::size_t cell_capacity,
            bool texel);
  // Makes the grid of the first `count` photons, whose keys have `digits` digits of SORT_BITS. Recorded, not submitted.
  void record(gpu::Commands& commands, std::uint32_t count, std::uint32_t digits);

 private:
  void record_scan(gpu::Commands& commands, std::uint32_t first, std::uint32_t count);

  gpu::Buffer pairs_;   // (key, photon): sorting goes to and fro between its halves
  gpu::Buffer counts_;  // of each digit in each chunk, and behind them the totals of each level of their scan
  std::uint32_t capacity_;
  gpu::ComputePass pass_;
  gpu::BindingSet buffers_;
};

}  // namespace meniscal::passes

// The hash grid: photons beside those of their cell, and each cell's range: host side of shaders/cells.comp.
#pragma once

#include "host/passes/photons.h"
#include "host/passes/sort.h"

namespace meniscal::passes {

class CellsPass {
 public:
  gpu::Buffer photons;  // GatheredPhoton[], in order of their cells
  gpu::Buffer cells;    // (first, one past the last) by key

  CellsPass(const gpu::Device& device, const PhotonBuffers& unsorted, const SortPass& sort, std::size_t capacity,
            std::size_t cell_capacity, bool texel);
  // Recorded, not submitted.
  void record(gpu::Commands& commands, std::uint32_t count, std::uint32_t digits);

 private:
  gpu::ComputePass pass_;
  gpu::BindingSet even_, odd_;  // for sorts by an even and an odd number of digits
};

}  // namespace meniscal::passes

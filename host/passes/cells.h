// The hash grid of the photon maps, by a stable radix sort: host side of shaders/cells.comp.
#pragma once

#include "host/passes/batch.h"
#include "host/passes/photons.h"

namespace meniscal::passes {

class CellsPass {
 public:
  gpu::Buffer listed;  // slots of photons, cell by cell, in each in order; with LISTED_TWICE
  gpu::Buffer cells;   // (first, one past the last) of these by key

  // For photons whose keys are below `cell_capacity`, with up to `capacity` entries in a grid. `texel`: photons are
  // read through texel buffers.
  CellsPass(const gpu::Device& device, const PhotonBuffers& photons, std::size_t capacity, std::size_t cell_capacity,
            bool texel);
  // Makes the grid of photons [first, first + count), or of fewer from `first` on where these have more entries than
  // there is room for; returns how many. Error(ExitCode::failed) where not even one fits. The last steps are recorded,
  // not submitted.
  std::uint32_t build(gpu::Commands& commands, const Grid& grid, std::uint32_t first, std::uint32_t count);

 private:
  void dispatch(gpu::Commands& commands, const shared::CellsPush& push, std::uint32_t invocations);
  std::uint32_t record_scan(gpu::Commands& commands, std::uint32_t first, std::uint32_t count);

  gpu::Buffer entries_;  // (key, photon): sorting goes to and fro between its halves
  gpu::Buffer counts_;   // scanned: of each photon's cells, then of each digit in each chunk; behind them the totals
  std::string stage_;    // that its dispatches are
  std::uint32_t capacity_;
  gpu::ComputePass pass_;
  gpu::BindingSet buffers_;
};

// Entries to have room for with so many photons at once: enough for nearly all scenes, within the 128 MiB a buffer that
// Vulkan guarantees.
std::size_t entry_capacity(std::size_t photons);

}  // namespace meniscal::passes

// The photons of a pass on the GPU, and the grid that they are kept in.
#pragma once

#include "host/gpu/buffer.h"
#include "host/render/settings.h"

namespace meniscal::passes {

// One slot per started photon.
struct PhotonBuffers {
  std::string map;  // what names of buffers and stages begin with: "global ", or nothing for the caustics' maps
  gpu::Buffer ends, discs;
  gpu::Buffer arrivals;  // uint: pack_direction; none where nothing asks which way a photon came
  PhotonBuffers(const gpu::Device& device, std::size_t capacity, bool glossy, bool global = false);
};

// The hash grid in one pass: cells of several sizes, each photon in those of its disc's size that the disc reaches
// into.
struct Grid {
  Discs discs;
  std::uint32_t levels;  // cell sizes: those of discs.narrowest doubled so many times
  std::uint32_t mask;    // cells of one level - 1
  std::uint32_t digits;  // of shared::SORT_BITS, that keys need

  std::size_t cells() const { return std::size_t(levels) * (mask + 1); }
};
Grid make_grid(std::uint32_t photons, const Discs& discs);
// Of the grids of up to so many photons.
std::size_t most_cells(std::uint32_t photons);

}  // namespace meniscal::passes

#include "host/passes/cells.h"

#include <utility>

#include "shaders/shaders.h"

namespace meniscal::passes {
namespace {

using shared::CellsPush, shared::SCAN_BLOCK, shared::SORT_BINS, shared::SORT_BITS, shared::SORT_CHUNK;

std::uint32_t blocks(std::size_t count, std::uint32_t size) {
  return static_cast<std::uint32_t>((count + size - 1) / size);
}

std::size_t counters(std::size_t capacity) {
  std::size_t level = std::size_t(blocks(capacity, SORT_CHUNK)) * SORT_BINS, sum = level;
  while (level > 1) sum += level = blocks(level, SCAN_BLOCK);
  return sum + 1;
}

gpu::ComputePass make_pass(const gpu::Device& device, bool texel) {
  const gpu::Kind storage = gpu::Kind::storage, table = texel ? gpu::Kind::texel : storage;
  return {device,
          "cells",
          shader("cells", texel),
          {{0, storage}, {1, table}, {2, table}, {3, storage}, {4, storage}, {5, storage}, {6, storage}},
          sizeof(CellsPush)};
}

}  // namespace

CellsPass::CellsPass(const gpu::Device& device, const PhotonBuffers& unsorted, std::size_t capacity,
                     std::size_t cell_capacity, bool texel)
    : photons(device, "photon map", capacity * sizeof(shared::GatheredPhoton)),
      cells(device, "grid cells", cell_capacity * 8),
      pairs_(device, "photons by cell", 2 * capacity * 8),
      counts_(device, "digit counts", counters(capacity) * 4),
      capacity_(static_cast<std::uint32_t>(capacity)),
      pass_(make_pass(device, texel)),
      buffers_(pass_.bind({{0, unsorted.keys},
                           {1, unsorted.ends, gpu::Format::rgba32ui},
                           {2, unsorted.discs, gpu::Format::rgba32ui},
                           {3, pairs_},
                           {4, counts_},
                           {5, photons},
                           {6, cells}})) {}

void CellsPass::record(gpu::Commands& commands, std::uint32_t count, std::uint32_t digits) {
  commands.fill(cells, 0);
  const std::uint32_t chunks = blocks(count, SORT_CHUNK);
  std::uint32_t from = 0, to = capacity_;  // the first digit is read from the keys
  for (std::uint32_t digit = 0; digit < digits; ++digit, std::swap(from, to)) {
    CellsPush push{shared::CELLS_COUNT, count, from, to, digit * SORT_BITS, chunks};
    commands.fill(counts_, 0);
    commands.barrier();
    commands.dispatch(pass_, buffers_, push, groups_of_64(chunks));
    commands.barrier();
    record_scan(commands, 0, chunks * SORT_BINS);
    push.step = shared::CELLS_MOVE;
    commands.dispatch(pass_, buffers_, push, groups_of_64(chunks));
    commands.barrier();
  }
  commands.dispatch(pass_, buffers_, CellsPush{shared::CELLS_COLLECT, count, from, 0, 0, 0}, groups_of_64(count));
  commands.barrier();
}

void CellsPass::record_scan(gpu::Commands& commands, std::uint32_t first, std::uint32_t count) {
  const std::uint32_t totals = blocks(count, SCAN_BLOCK);
  CellsPush push{shared::CELLS_SCAN, count, first, first + count, 0, 0};
  commands.dispatch(pass_, buffers_, push, groups_of_64(totals));
  commands.barrier();
  if (totals <= 1) return;
  record_scan(commands, first + count, totals);
  push.step = shared::CELLS_ADD;
  commands.dispatch(pass_, buffers_, push, groups_of_64(totals));
  commands.barrier();
}

}  // namespace meniscal::passes

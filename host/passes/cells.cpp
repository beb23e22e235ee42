#include "host/passes/cells.h"

#include <utility>

#include "host/error.h"
#include "shaders/shaders.h"

namespace meniscal::passes {
namespace {

using shared::CellsPush, shared::SCAN_BLOCK, shared::SORT_BINS, shared::SORT_BITS, shared::SORT_CHUNK;

std::uint32_t blocks(std::size_t count, std::uint32_t size) {
  return static_cast<std::uint32_t>((count + size - 1) / size);
}

std::size_t with_totals(std::size_t count) {
  std::size_t sum = count + 1;
  while (count > 1) sum += count = blocks(count, SCAN_BLOCK);
  return sum;
}

std::size_t counters(std::size_t photons, std::size_t entries) {
  return with_totals(std::max(photons, std::size_t(blocks(entries, SORT_CHUNK)) * SORT_BINS));
}

gpu::ComputePass make_pass(const gpu::Device& device, bool texel) {
  const gpu::Kind storage = gpu::Kind::storage, table = texel ? gpu::Kind::texel : storage;
  return {device,
          "cells",
          shader("cells", texel),
          {{0, table}, {1, storage}, {2, storage}, {3, storage}, {4, storage}, {5, table}},
          sizeof(CellsPush)};
}

}  // namespace

CellsPass::CellsPass(const gpu::Device& device, const PhotonBuffers& photons, std::size_t capacity,
                     std::size_t cell_capacity, bool texel)
    : listed(device, photons.map + "photons by cell", capacity * 4),
      cells(device, photons.map + "grid cells", cell_capacity * 8),
      entries_(device, photons.map + "grid entries", 2 * capacity * 8),
      counts_(device, photons.map + "grid counts",
              counters(photons.discs.bytes() / sizeof(shared::PhotonDisc), capacity) * 4),
      stage_(photons.map + "grid"),
      capacity_(static_cast<std::uint32_t>(capacity)),
      pass_(make_pass(device, texel)),
      buffers_(pass_.bind({{0, photons.discs, gpu::Format::rgba32ui},
                           {1, entries_},
                           {2, counts_},
                           {3, listed},
                           {4, cells},
                           {5, entries_, gpu::Format::rg32ui}})) {}

std::uint32_t CellsPass::build(gpu::Commands& commands, const Grid& grid, std::uint32_t first, std::uint32_t count) {
  CellsPush push{};
  push.narrowest = static_cast<float>(grid.discs.narrowest);
  push.levels = grid.levels;
  push.cell_mask = grid.mask;
  push.count = count;
  push.from = first;
  push.step = shared::CELLS_NUMBER;
  dispatch(commands, push, count);
  const std::uint32_t total = record_scan(commands, 0, count);
  commands.submit_and_wait();
  const std::uint32_t entries = counts_.download<std::uint32_t>(total, 1).front();
  if (entries > capacity_) {
    if (count == 1)
      throw Error(ExitCode::failed,
                  "photon map: one photon reaches into " + std::to_string(entries) +
                      " cells, more than there is room for: an error in the program, please report it");
    return build(commands, grid, first, (count + 1) / 2);
  }
  push.step = shared::CELLS_ENTER;
  dispatch(commands, push, count);

  commands.fill(cells, 0);
  push.count = entries;
  push.chunks = blocks(entries, SORT_CHUNK);
  push.from = 0, push.to = capacity_;
  for (std::uint32_t digit = 0; digit < grid.digits; ++digit, std::swap(push.from, push.to)) {
    push.shift = digit * SORT_BITS;
    push.step = shared::CELLS_COUNT;
    commands.fill(counts_, 0);
    commands.barrier();
    dispatch(commands, push, push.chunks);
    record_scan(commands, 0, push.chunks * SORT_BINS);
    push.step = shared::CELLS_MOVE;
    dispatch(commands, push, push.chunks);
  }
  push.step = shared::CELLS_COLLECT;
  dispatch(commands, push, entries);
  return count;
}

void CellsPass::dispatch(gpu::Commands& commands, const CellsPush& push, std::uint32_t invocations) {
  commands.dispatch(pass_, buffers_, push, groups_of_64(invocations), stage_);
  commands.barrier();
}

// Returns where in the counts their total is then.
std::uint32_t CellsPass::record_scan(gpu::Commands& commands, std::uint32_t first, std::uint32_t count) {
  const std::uint32_t totals = blocks(count, SCAN_BLOCK);
  CellsPush push{};
  push.count = count, push.from = first, push.to = first + count;
  push.step = shared::CELLS_SCAN;
  dispatch(commands, push, totals);
  if (totals <= 1) return first + count;
  const std::uint32_t total = record_scan(commands, first + count, totals);
  push.step = shared::CELLS_ADD;
  dispatch(commands, push, totals);
  return total;
}

std::size_t entry_capacity(std::size_t photons) {
  constexpr std::size_t least = 1u << 12, most = 1u << 23, per_photon = 10;
  return std::clamp(per_photon * photons, least, most);
}

}  // namespace meniscal::passes

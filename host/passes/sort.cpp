#include "host/passes/sort.h"

#include "shaders/shaders.h"

namespace meniscal::passes {
namespace {

using shared::SCAN_BLOCK, shared::SORT_BINS, shared::SORT_BITS, shared::SORT_CHUNK;

std::uint32_t blocks(std::size_t count, std::uint32_t size) {
  return static_cast<std::uint32_t>((count + size - 1) / size);
}

// Counters of all chunks, and behind them the totals of each level of the scan.
std::size_t counters(std::size_t capacity) {
  std::size_t level = std::size_t(blocks(capacity, SORT_CHUNK)) * SORT_BINS, sum = level;
  while (level > 1) sum += level = blocks(level, SCAN_BLOCK);
  return sum + 1;
}

std::vector<gpu::Binding> storage(std::uint32_t count) {
  std::vector<gpu::Binding> bindings;
  for (std::uint32_t i = 0; i < count; ++i) bindings.push_back({i, gpu::Kind::storage});
  return bindings;
}

}  // namespace

SortPass::SortPass(const gpu::Device& device, const gpu::Buffer& keys, std::size_t capacity)
    : keys_(keys),
      values_(device, "sort values", capacity * 4),
      other_keys_(device, "sorted keys", capacity * 4),
      other_values_(device, "sorted values", capacity * 4),
      counts_(device, "sort counts", counters(capacity) * 4),
      count_(device, "sort_count", shader("sort_count", true), storage(2), sizeof(shared::SortPush)),
      scan_(device, "scan", shader("scan", true), storage(1), sizeof(shared::ScanPush), {0}),
      add_(device, "scan_add", shader("scan", true), storage(1), sizeof(shared::ScanPush), {1}),
      scatter_(device, "sort_scatter", shader("sort_scatter", true), storage(5), sizeof(shared::SortPush)),
      count_there_(count_.bind({{0, keys_}, {1, counts_}})),
      count_back_(count_.bind({{0, other_keys_}, {1, counts_}})),
      scan_counts_(scan_.bind({{0, counts_}})),
      add_counts_(add_.bind({{0, counts_}})),
      scatter_there_(scatter_.bind({{0, keys_}, {1, counts_}, {2, values_}, {3, other_keys_}, {4, other_values_}})),
      scatter_back_(scatter_.bind({{0, other_keys_}, {1, counts_}, {2, other_values_}, {3, keys_}, {4, values_}})) {}

SortPass::Sorted SortPass::sorted(std::uint32_t digits) const {
  if (digits % 2 == 1) return {&other_keys_, &other_values_};
  return {&keys_, &values_};
}

void SortPass::record(gpu::Commands& commands, std::uint32_t count, std::uint32_t digits) {
  const std::uint32_t chunks = blocks(count, SORT_CHUNK);
  for (std::uint32_t digit = 0; digit < digits; ++digit) {
    const bool there = digit % 2 == 0;
    const shared::SortPush push{count, digit * SORT_BITS, chunks, digit == 0 ? 1u : 0u};
    commands.dispatch(count_, there ? count_there_ : count_back_, push, groups_of_64(chunks));
    commands.barrier();
    record_scan(commands, 0, chunks * SORT_BINS);
    commands.dispatch(scatter_, there ? scatter_there_ : scatter_back_, push, groups_of_64(chunks));
    commands.barrier();
  }
}

void SortPass::record_scan(gpu::Commands& commands, std::uint32_t first, std::uint32_t count) {
  const std::uint32_t totals = blocks(count, SCAN_BLOCK);
  const shared::ScanPush push{first, count, first + count, 0};
  commands.dispatch(scan_, scan_counts_, push, groups_of_64(totals));
  commands.barrier();
  if (totals <= 1) return;
  record_scan(commands, first + count, totals);
  commands.dispatch(add_, add_counts_, push, groups_of_64(totals));
  commands.barrier();
}

}  // namespace meniscal::passes

// Stable radix sort of keys with their indices: host side of shaders/sort_count.comp, scan.comp and sort_scatter.comp.
#pragma once

#include "host/passes/batch.h"
#include "shaders/shared/structs.h"

namespace meniscal::passes {

class SortPass {
 public:
  struct Sorted {
    const gpu::Buffer *keys, *values;  // values: indices into what was sorted
  };

  // `keys`: up to `capacity` keys; overwritten by sorting.
  SortPass(const gpu::Device& device, const gpu::Buffer& keys, std::size_t capacity);

  // Sorts the first `count` keys by their `digits` lowest digits of SORT_BITS. Recorded, not submitted; ends with a
  // barrier.
  void record(gpu::Commands& commands, std::uint32_t count, std::uint32_t digits);
  // Where the result of sorting by so many digits lies: the passes go to and fro.
  Sorted sorted(std::uint32_t digits) const;

 private:
  void record_scan(gpu::Commands& commands, std::uint32_t first, std::uint32_t count);

  const gpu::Buffer& keys_;
  gpu::Buffer values_, other_keys_, other_values_, counts_;
  gpu::ComputePass count_, scan_, add_, scatter_;
  gpu::BindingSet count_there_, count_back_, scan_counts_, add_counts_, scatter_there_, scatter_back_;
};

}  // namespace meniscal::passes

// Long dispatches are killed by desktop watchdogs: work is cut into batches sized by how long the last one took.
#pragma once

#include <algorithm>
#include <cstdint>

#include "host/gpu/choices.h"
#include "host/gpu/commands.h"

namespace meniscal::passes {

class Batch {
 public:
  // Calls record(first, count) for consecutive parts of [0, total), submitting each. What is computed does not depend
  // on the cuts.
  template <class Record>
  void run(gpu::Commands& commands, std::uint32_t total, const Record& record) {
    const gpu::Choices& choices = commands.choices();
    if (size_ == 0) size_ = choices.first_batch;
    for (std::uint32_t first = 0, count = 0; first < total; first += count) {
      count = std::min(size_, total - first);
      record(first, count);
      commands.submit_and_wait();
      if (commands.last_submit_seconds() < choices.batch_seconds / 2)
        size_ = std::min(2 * size_, choices.largest_batch);
      else if (commands.last_submit_seconds() > 2 * choices.batch_seconds)
        size_ = std::max(size_ / 2, 1u << 10);
    }
  }

 private:
  std::uint32_t size_ = 0;  // 0: none run yet
};

inline std::uint32_t groups_of_64(std::uint32_t items) {
  static_assert(gpu::Choices::workgroup == 64);
  return (items + 63) / 64;
}

}  // namespace meniscal::passes

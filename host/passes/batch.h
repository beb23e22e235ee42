// Long dispatches are killed by desktop watchdogs: work is cut into batches sized by how long the last one took.
#pragma once

#include <algorithm>
#include <cstdint>

#include "host/gpu/commands.h"

namespace meniscal::passes {

class Batch {
 public:
  // Calls record(first, count) for consecutive parts of [0, total), submitting each. What is computed does not depend
  // on the cuts.
  template <class Record>
  void run(gpu::Commands& commands, std::uint32_t total, const Record& record) {
    for (std::uint32_t first = 0, count = 0; first < total; first += count) {
      count = std::min(size_, total - first);
      record(first, count);
      commands.submit_and_wait();
      if (commands.last_submit_seconds() < target_seconds / 2)
        size_ = std::min(2 * size_, 1u << 22);
      else if (commands.last_submit_seconds() > 2 * target_seconds)
        size_ = std::max(size_ / 2, 1u << 10);
    }
  }

 private:
  static constexpr double target_seconds = 0.05;
  std::uint32_t size_ = 1u << 16;
};

inline std::uint32_t groups_of_64(std::uint32_t items) { return (items + 63) / 64; }

}  // namespace meniscal::passes

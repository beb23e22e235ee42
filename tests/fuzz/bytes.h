// A fuzzer's bytes as choices; zeros where they end, so that every input means something.
#pragma once

#include <cstddef>
#include <cstdint>

namespace meniscal::fuzz {

class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : next_(data), end_(data + size) {}

  bool empty() const { return next_ == end_; }
  unsigned byte() { return next_ == end_ ? 0 : *next_++; }
  unsigned below(unsigned count) { return byte() % count; }
  // One of 256 even steps from `low` to `high`: coarse, so that coordinates coincide.
  double step(double low, double high) { return low + (high - low) * byte() / 255.0; }

 private:
  const std::uint8_t *next_, *end_;
};

// Ends the program where `holds` is false: a find. Release builds, too.
inline void require(bool holds) {
  if (!holds) __builtin_trap();
}

}  // namespace meniscal::fuzz

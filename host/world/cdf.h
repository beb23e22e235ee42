// Cumulative probabilities as both sides sample them.
#pragma once

#include <cstdint>
#include <vector>

namespace meniscal {

// Appends cumulative probabilities in units of 2^-32; from the last entry with a weight on they are 2^32 - 1, so that
// every number finds an entry that has one.
template <class Weight>
void append_cdf(std::vector<std::uint32_t>& cdf, std::size_t count, Weight weight) {
  double sum = 0, total = 0;
  for (std::size_t i = 0; i < count; ++i) total += weight(i);
  for (std::size_t i = 0; i < count; ++i) {
    sum += weight(i);
    cdf.push_back(sum >= total ? 0xFFFFFFFFu : static_cast<std::uint32_t>(sum / total * 4294967295.0));
  }
}

}  // namespace meniscal

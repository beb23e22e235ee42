// Which passes a picture is the mean of: ranges, as several machines rendered them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace meniscal {

constexpr std::uint32_t most_passes = 0x7FFFFFFF;  // the pilot takes the random numbers of those beyond

struct PassRange {
  std::uint32_t first = 0, last = 0;  // first <= pass < last
  std::uint32_t count() const { return last - first; }
};

// In order, apart from each other, none empty.
using PassRanges = std::vector<PassRange>;

// Passes that both have, if any.
std::optional<PassRange> overlap(const PassRanges& a, const PassRanges& b);

// Passes of either; neighbours become one range. They must not overlap.
PassRanges joined(const PassRanges& a, const PassRanges& b);

std::uint64_t count(const PassRanges& ranges);

// "0:4,6:8", and back; nothing where the text holds something else, empty ranges, or overlapping ones.
std::string to_text(const PassRanges& ranges);
std::optional<PassRanges> parse_pass_ranges(const std::string& text);

}  // namespace meniscal

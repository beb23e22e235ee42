#include "host/render/pass_ranges.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace meniscal {

std::optional<PassRange> overlap(const PassRanges& a, const PassRanges& b) {
  for (const PassRange& x : a)
    for (const PassRange& y : b) {
      const PassRange both{std::max(x.first, y.first), std::min(x.last, y.last)};
      if (both.first < both.last) return both;
    }
  return std::nullopt;
}

PassRanges joined(const PassRanges& a, const PassRanges& b) {
  PassRanges all = a;
  all.insert(all.end(), b.begin(), b.end());
  std::sort(all.begin(), all.end(), [](const PassRange& x, const PassRange& y) { return x.first < y.first; });
  PassRanges apart;
  for (const PassRange& r : all)
    if (!apart.empty() && apart.back().last == r.first)
      apart.back().last = r.last;
    else
      apart.push_back(r);
  return apart;
}

std::uint64_t count(const PassRanges& ranges) {
  std::uint64_t passes = 0;
  for (const PassRange& r : ranges) passes += r.count();
  return passes;
}

std::string to_text(const PassRanges& ranges) {
  std::vector<std::string> texts;
  for (const PassRange& r : ranges) texts.push_back(fmt::format("{}:{}", r.first, r.last));
  return fmt::format("{}", fmt::join(texts, ","));
}

std::optional<PassRanges> parse_pass_ranges(const std::string& text) {
  PassRanges ranges;
  const char *at = text.data(), *const end = at + text.size();
  while (true) {
    PassRange r;
    const auto [colon, first_error] = std::from_chars(at, end, r.first);
    if (first_error != std::errc() || colon == end || *colon != ':') return std::nullopt;
    const auto [comma, last_error] = std::from_chars(colon + 1, end, r.last);
    if (last_error != std::errc() || r.last <= r.first || overlap(ranges, {r})) return std::nullopt;
    ranges = joined(ranges, {r});
    if (comma == end) return ranges;
    if (*comma != ',') return std::nullopt;
    at = comma + 1;
  }
}

}  // namespace meniscal

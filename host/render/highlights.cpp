#include "host/render/highlights.h"

#include <algorithm>

namespace meniscal {

std::uint32_t find_highlights(const World& world) {
  constexpr std::ptrdiff_t most_areas = 64;  // every cell asks each of them
  const bool menisci = std::any_of(world.strata.begin(), world.strata.end(),
                                   [](const Stratum& s) { return s.map == shared::MAP_TARGETED; });
  const auto count = [&](std::uint32_t type) {
    return std::count_if(world.lights.begin(), world.lights.end(), [&](const auto& l) { return l.type == type; });
  };
  const std::ptrdiff_t areas = count(shared::LIGHT_AREA), environments = count(shared::LIGHT_ENVIRONMENT);
  const auto others = static_cast<std::ptrdiff_t>(world.lights.size()) - areas - environments;
  if (menisci && areas > 0 && areas <= most_areas) return shared::HIGHLIGHTS_ALL;
  return menisci && others > 0 ? shared::HIGHLIGHTS_NO_AREAS : shared::HIGHLIGHTS_NONE;
}

void HighlightPixels::add(const std::vector<shared::PixelSample>& samples) {
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (samples[i].highlighted != 0) met_[i] = true;
}

std::vector<std::uint32_t> HighlightPixels::pixels() const {
  const std::size_t height = met_.size() / width_;
  std::vector<std::uint32_t> found;
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width_; ++x) {
      bool near = false;
      for (std::size_t v = y > 0 ? y - 1 : y; v < std::min(y + 2, height); ++v)
        for (std::size_t u = x > 0 ? x - 1 : x; u < std::min(x + 2, width_); ++u) near = near || met_[v * width_ + u];
      if (near) found.push_back(static_cast<std::uint32_t>(y * width_ + x));
    }
  return found;
}

}  // namespace meniscal

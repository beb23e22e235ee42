#include "host/render/highlights.h"

#include <fmt/format.h>

#include <algorithm>

#include "shaders/shared/highlights.h"

namespace meniscal {

Highlights find_highlights(const World& world) {
  constexpr std::size_t most_lights = 64;
  if (std::none_of(world.strata.begin(), world.strata.end(),
                   [](const Stratum& s) { return s.map == shared::MAP_TARGETED; }))
    return {shared::HIGHLIGHTS_NONE, "no menisci"};
  std::size_t areas = 0, discs = 0;
  for (const shared::Light& light : world.lights) {
    const bool wide = light.type == shared::LIGHT_DIRECTIONAL && light.cone_versine > shared::MOST_VERSINE;
    areas += light.type == shared::LIGHT_AREA;
    discs += light.type != shared::LIGHT_AREA && light.type != shared::LIGHT_ENVIRONMENT && !wide;
  }
  if (areas + discs == 0) return {shared::HIGHLIGHTS_NONE, "no light to be seen in menisci"};
  if (areas > 0 && areas + discs <= most_lights)
    return {shared::HIGHLIGHTS_ALL, fmt::format("{} lights that may be seen in menisci", areas + discs)};
  const std::string left = areas == 0 ? "" : fmt::format("{} emissive triangles are left to camera paths", areas);
  if (discs > most_lights)
    return {shared::HIGHLIGHTS_NONE, fmt::format("{} lights are more than {}", areas + discs, most_lights)};
  if (discs == 0) return {shared::HIGHLIGHTS_NONE, left};
  return {shared::HIGHLIGHTS_NO_AREAS,
          fmt::format("{} lights that may be seen in menisci{}{}", discs, areas > 0 ? "; " : "", left)};
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

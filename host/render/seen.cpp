#include "host/render/seen.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <map>

namespace meniscal {
namespace {

constexpr double size_by_distance = 1.5;

bool visible(const shared::PixelSample& s) { return s.triangle < shared::END_FIRST; }

// 20 bits an axis.
std::uint64_t key(const glm::i64vec3& cell) {
  const auto bits = [](std::int64_t c) { return static_cast<std::uint64_t>(c) & 0xFFFFF; };
  return bits(cell.x) | bits(cell.y) << 20 | bits(cell.z) << 40;
}

}  // namespace

SeenCells::SeenCells(std::span<const shared::PixelSample> samples, std::uint32_t width, double least) {
  // Distance to the nearest of the pixels beside, as a power of 2.
  const auto octave = [&](std::size_t i) {
    double nearest = std::numeric_limits<double>::infinity();
    const auto beside = [&](std::size_t j) {
      if (j >= samples.size() || !visible(samples[j])) return;
      nearest = std::min(nearest, double(glm::distance(samples[i].position, samples[j].position)));
    };
    if (i % width > 0) beside(i - 1);
    if (i % width + 1 < width) beside(i + 1);
    beside(i - width);
    beside(i + width);
    if (!(nearest > 0) || !std::isfinite(nearest)) return std::optional<int>();
    return std::optional(int(std::ceil(std::log2(std::max(nearest, least / size_by_distance)))));
  };
  std::map<int, Level> by_octave;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!visible(samples[i])) continue;
    const auto o = octave(i);
    if (!o) continue;
    Level& level = by_octave[*o];
    level.size = size_by_distance * std::exp2(*o);
    level.cells.insert(key(glm::i64vec3(glm::floor(glm::dvec3(samples[i].position) / level.size))));
  }
  for (auto& [o, level] : by_octave) levels_.push_back(std::move(level));
}

bool SeenCells::contains(const glm::dvec3& point) const {
  for (const Level& level : levels_) {
    const glm::i64vec3 low(glm::floor(point / level.size - 0.5));
    for (int c = 0; c < 8; ++c)
      if (level.cells.count(key(low + glm::i64vec3(c & 1, (c >> 1) & 1, c >> 2)))) return true;
  }
  return false;
}

}  // namespace meniscal

// The floor under a vertical post in rings round its axis, against tables by rings.
#pragma once

#include <cmath>

#include "tests/support/scene_setup.h"

namespace meniscal::test {

constexpr double ring_mm = 0.05;

struct Rings {
  std::vector<double> irradiance;  // mean over the samples of each 0.05 mm ring, relative to the light's
  Tallies tallies;                 // sums over the passes
  double final_radius_mm = 0;
};

inline Rings render_rings(const Setup& setup, std::uint32_t passes) {
  GpuBackend gpu(gpu::Device::open("auto"), setup.world, setup.settings);
  std::vector<double> sums(240), counts(240);
  Rings rings;
  for (std::uint32_t pass = 0; pass < passes; ++pass) {
    const PassResult result = render_pass(gpu, pass);
    for (const shared::PixelSample& s : result.samples) {
      const auto bin = static_cast<std::size_t>(1e3 * std::hypot(double(s.position.x), double(s.position.z)) / ring_mm);
      if (s.triangle >= shared::END_FIRST || bin >= sums.size()) continue;
      sums[bin] += double(s.direct.x + s.targeted.x + s.caustic.x);
      counts[bin] += 1;
    }
    for (std::size_t i = 0; i < rings.tallies.size(); ++i) rings.tallies[i].add(result.tallies[i]);
  }
  for (std::size_t i = 0; i < sums.size(); ++i) rings.irradiance.push_back(counts[i] > 0 ? sums[i] / counts[i] : 0);
  rings.final_radius_mm = 1e3 * disc_radius(setup.settings, passes - 1);
  return rings;
}

inline double mean_beyond(const Rings& rings, double from_mm, double to_mm) {
  double sum = 0, weight = 0;
  for (std::size_t i = 0; i < rings.irradiance.size(); ++i) {
    const double r = (double(i) + 0.5) * ring_mm;
    if (r < from_mm || r > to_mm) continue;
    sum += r * rings.irradiance[i];
    weight += r;
  }
  return sum / weight;
}

inline RenderOptions post_options() {
  RenderOptions options = small_options(500000, 400, 400);
  options.radius = 2.1e-4;
  return options;
}

// Of the rings from 2.5 to 12 mm, relative where the truth is above 1. Those beside a fold or a jump are blurred by the
// kernel: left out within two rings or the final radius.
struct Deviation {
  double rms = 0, worst = 0;
  int rings = 0;
};
inline Deviation compare(const Rings& rings, const std::vector<double>& truth, int first = 50) {
  const auto reach = static_cast<int>(std::ceil(std::max(2.0, rings.final_radius_mm / ring_mm)));
  const auto beside_jump = [&](int ring) {
    for (int i = std::max(ring - reach, 0); i <= ring + reach && i + 1 < int(truth.size()); ++i)
      if (std::abs(truth[i + 1] - truth[i]) > 0.1) return true;
    return false;
  };
  Deviation off;
  double squares = 0;
  for (int i = first; i < 240; ++i) {
    if (beside_jump(i)) continue;
    const double error = (rings.irradiance[i] - truth[i]) / std::max(truth[i], 1.0);
    squares += error * error;
    off.worst = std::max(off.worst, std::abs(error));
    ++off.rings;
  }
  off.rms = std::sqrt(squares / off.rings);
  return off;
}

}  // namespace meniscal::test

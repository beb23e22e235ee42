#include "host/render/budgets.h"

#include <algorithm>
#include <cmath>

namespace meniscal {

Budgets share_photons(const Budgets& budgets, const MapNoise& noise) {
  constexpr double least = 1.0 / 16;
  const double caustics = std::sqrt(noise.caustics), global = std::sqrt(noise.global);
  if (budgets.caustics == 0 || budgets.global == 0 || !(caustics + global > 0)) return budgets;
  const double all = double(budgets.caustics) + budgets.global, most = std::max(budgets.caustics, budgets.global);
  // In steps, so that a device that sees one photon more seldom decides otherwise.
  const double share = std::clamp(std::round(64 * global / (caustics + global)) / 64, least, 1 - least);
  const auto part = [&](double of) { return static_cast<std::uint32_t>(std::min(of * all, most)); };
  return {part(1 - share), part(share)};
}

}  // namespace meniscal

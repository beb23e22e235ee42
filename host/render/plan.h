// What a scene requires and what it does not: decided once, shown by `info` and in the statistics, carried into the shaders.
#pragma once

#include "host/render/settings.h"

namespace meniscal {

struct PlanEntry {
  std::string feature;
  bool on;
  std::string why;
};
using Plan = std::vector<PlanEntry>;

Plan make_plan(const World& world);

// Photons per pass by stratum: all of them together `photons`. None where no light could start them.
std::vector<std::uint32_t> photon_budget(const World& world, std::uint32_t photons);

// Gather radius of pass 0 by stratum: wide enough for some tens of photons where they are spread evenly over the stratum's
// area, between 1 and 16 pixels of `footprint` metres.
std::vector<double> default_radii(const World& world, const std::vector<std::uint32_t>& photons, double footprint);

}  // namespace meniscal

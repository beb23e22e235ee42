// What a scene requires and what it does not: decided once, shown by `info` and in the statistics, carried into the
// shaders.
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

// Photons per pass by stratum, all of them together at most `photons`: one half alike for each, one half as the square
// roots of the strata's areas. None where no light could start them.
std::vector<std::uint32_t> photon_budget(const World& world, std::uint32_t photons);

// Discs of pass 0: they reach over some photons of the stratum that has most a square metre. `footprint`: side of a
// pixel on what is seen, m.
Discs default_discs(const World& world, const std::vector<std::uint32_t>& photons, double footprint);

}  // namespace meniscal

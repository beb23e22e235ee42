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

// Bounds of the discs of pass 0. `footprint`: side of a pixel on what is seen, m.
Discs default_discs(const std::vector<shared::Beam>& beams, double footprint);

}  // namespace meniscal

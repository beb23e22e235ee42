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

// `diffuse_bounces`: asked for. `camera_media`: dielectrics that the camera is inside of. `highlights`: asked for.
Plan make_plan(const World& world, std::uint32_t diffuse_bounces, const glm::uvec4& camera_media,
               bool highlights = true);

// Discs of pass 0 for the beams and pixels of the settings. `radius`: of the scene, m.
Discs default_discs(const RenderSettings& settings, double radius);

}  // namespace meniscal

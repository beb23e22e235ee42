// Lights of the scene: suns, environment, other punctual ones, emissive triangles, with the probability of choosing
// each: by power.
#pragma once

#include "host/world/world.h"

namespace meniscal {

// Directional lights with an angular diameter.
inline bool is_sun(const shared::Light& light) {
  return light.type == shared::LIGHT_DIRECTIONAL && light.cone_versine > 0;
}

// For a world that has its triangles, surfaces and radius. Lights without power are left out.
std::vector<shared::Light> make_lights(const Scene& scene, const World& world, Stages& stages);

}  // namespace meniscal

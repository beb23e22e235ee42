// Lights of the scene, punctual and emissive, with the probability of choosing each: by power.
#pragma once

#include <span>

#include "host/world/world.h"

namespace meniscal {

// `radius`: of the scene, for the power of directional lights. Lights without power are left out.
std::vector<shared::Light> make_lights(const Scene& scene, std::span<const WorldTriangle> triangles,
                                       std::span<const shared::Surface> surfaces, double radius);

}  // namespace meniscal

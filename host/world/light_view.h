// Where photons start when one distant light is all there is: evenly over the light's own view of the targets.
#pragma once

#include "host/world/world.h"

namespace meniscal {

// A rectangle across the light, round the targets as it sees them, and behind all that could shade them. Starting there
// stratifies photons in two dimensions as no walk over triangles can, and the ray that finds the target is the one that
// asks for visibility. None where the scene has other lights too, or where the targets fill too little of their
// rectangle to be worth the photons that miss.
std::optional<LightView> find_light_view(const World& world, const Stratum& stratum);

}  // namespace meniscal

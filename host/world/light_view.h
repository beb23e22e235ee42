// What a distant light sees of the surfaces that photons start on.
#pragma once

#include "host/world/world.h"

namespace meniscal {

// A rectangle across the light, round all targets as it sees them, and behind all that could shade them. Starting there
// stratifies photons in two dimensions as no walk over triangles can, and the ray that finds the target is the one that
// asks for visibility. None for a light that is not distant, or where the targets fill too little of their rectangle to
// be worth the photons that miss.
std::optional<LightView> find_light_view(const World& world, const shared::Light& light);

// Bounds of a stratum's triangles in the view: low x, low y, high x, high y, in units of its edges.
glm::dvec4 bounds_in(const LightView& view, const World& world, const Stratum& stratum);

}  // namespace meniscal

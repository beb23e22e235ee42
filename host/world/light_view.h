// What a distant light sees of the surfaces that photons start on.
#pragma once

#include "host/world/world.h"

namespace meniscal {

// A rectangle across the light, round all targets as it sees them; photons start on their way through it, before all
// that could shade them. That stratifies them in two dimensions as no walk over triangles can, and the ray that finds
// the target is the one that asks for visibility. A sun's light goes through it in all directions of its cone: the
// rectangle is as much wider as no target needs to be missed for. None for a light that is not distant, for a wide sun,
// or where the targets fill too little of their rectangle to be worth the photons that miss.
std::optional<LightView> find_light_view(const World& world, const shared::Light& light);

// Bounds of a stratum's triangles in the view: low x, low y, high x, high y, in units of its edges.
glm::dvec4 bounds_in(const LightView& view, const World& world, const Stratum& stratum);

}  // namespace meniscal

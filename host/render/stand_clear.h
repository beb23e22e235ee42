// A camera on a surface.
#pragma once

#include "host/world/world.h"

namespace meniscal {

// Where rays from `point`, metres, do not meet by chance the surface that it lies on: as far from it as single
// precision tells (2e-6 of the scene's radius) on the side where it is, in front where it is on it; so in a corner from
// each of its faces. Elsewhere the point itself.
glm::dvec3 stand_clear(const World& world, const glm::dvec3& point);

}  // namespace meniscal

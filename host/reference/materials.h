// Surfaces at a point.
#pragma once

#include "host/reference/tracer.h"

namespace meniscal::reference {

// What the surface is where the ray hit it; `hit.shading` as its textures bend it.
shared::Surface shade(const World& world, Hit& hit);

}  // namespace meniscal::reference

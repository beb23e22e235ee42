// Surfaces at a point.
#pragma once

#include "host/reference/tracer.h"

namespace meniscal::reference {

// What the surface is where the ray hit it; `hit.shading` as its textures bend it.
shared::Surface shade(const World& world, Hit& hit);

// What the emissive texture of a light's triangle makes of its emission at a point.
glm::dvec3 emitted_part(const World& world, std::uint32_t triangle, const glm::dvec3& point);

}  // namespace meniscal::reference

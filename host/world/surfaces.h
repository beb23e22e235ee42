// Materials -> what the tracer does at a surface.
#pragma once

#include "host/scene/scene.h"
#include "shaders/shared/structs.h"

namespace meniscal {

// Below this roughness a surface is specular (S), above it is diffuse (D): photons are stored there (physics: photons).
inline constexpr double specular_roughness = 0.05;

// Where its texture is brightest: it decides for all of a material whether it is smooth.
inline double largest_roughness(const Material& m) { return m.roughness * m.most_roughness; }

// Of a material with textures, what textured() (shaders/shared/textures.h) takes where it is met.
// `closed`: stands on closed meshes; decides whether a transmissive material without thickness refracts.
shared::Surface make_surface(const Material& material, bool closed);

}  // namespace meniscal

// Textures of the world's materials: what they say at a place, and on average.
#pragma once

#include "host/world/world.h"

namespace meniscal {

// Of coordinates in both sets: red, green, blue and alpha in [0, 1], linear.
glm::dvec4 look_up(const Texture& texture, const glm::dvec4& coordinates);

// Notes the material's textures; what Surface::textures is to be. 0: it has none.
std::uint32_t add_textures(World& world, const Material& material);

// By triangle, the mean of the emissive texture over it, a factor on its surface's emission. Empty: no emissive
// textures.
std::vector<glm::dvec3> mean_emission_factors(const World& world);

}  // namespace meniscal

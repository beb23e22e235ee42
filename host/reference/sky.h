// What lies beyond the scene: suns (directional lights with an angular diameter) and the environment, an image of all
// directions. The specification of shaders/sky.glsl.
#pragma once

#include "host/world/world.h"

namespace meniscal::reference {

// Of a photon's footprint by the light, rad: derivatives tell nothing of wider ones.
inline constexpr double most_extent = 1;

struct DistantSample {
  glm::dvec3 direction;   // towards the light
  glm::dvec3 irradiance;  // on a surface facing it, over the density of this direction
  double solid_angle;     // 1 / that density; 0: there is but one direction
};

// A direction to a directional light (uniform in its cone) or to the environment (by radiance times solid angle).
// `place`: uniform in the unit square.
DistantSample sample_distant(const World& world, const shared::Light& light, const glm::dvec2& place);

struct SkySample {
  glm::dvec3 radiance;
  double pdf;  // density, per solid angle, with which a light picked by power gives this direction (see area_light_pdf)
};

// What a ray sees that leaves the scene; `in_meniscus`: but for suns that highlights show.
SkySample sky(const World& world, const glm::dvec3& direction, bool in_meniscus = false);

}  // namespace meniscal::reference

#include "host/reference/emission.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "host/reference/materials.h"
#include "host/reference/sky.h"

namespace meniscal::reference {
namespace {

constexpr double pi = glm::pi<double>();

}  // namespace

Emission emit(const Tracer& tracer, const glm::dvec2& place, const shared::RandomKey& key) {
  const World& world = tracer.world();
  const Picked picked =
      pick(world.cdf, world.light_first, world.lights.size(), shared::random_bits(key, shared::DIM_LIGHT));
  const shared::Light& light = world.lights[picked.index];
  const glm::dvec3 axis = glm::normalize(glm::dvec3(light.direction));
  Emission e{{glm::dvec3(light.position), axis}, glm::dvec3(light.intensity) * picked.weight, no_triangle, light.media};
  if (light.type == shared::LIGHT_DIRECTIONAL || light.type == shared::LIGHT_ENVIRONMENT) {
    const DistantSample s = sample_distant(
        world, light,
        {double(shared::random_unit(key, shared::DIM_LIGHT_U)), double(shared::random_unit(key, shared::DIM_LIGHT_V))});
    e.ray.direction = -s.direction;
    e.ray.origin = world.radius * around(e.ray.direction, std::sqrt(place.x), -1.01, place.y);
    e.flux = s.irradiance * picked.weight * pi * world.radius * world.radius;
  } else if (light.type == shared::LIGHT_AREA) {
    const double root = std::sqrt(double(shared::random_unit(key, shared::DIM_LIGHT_U)));
    const double v = root * double(shared::random_unit(key, shared::DIM_LIGHT_V));
    const bool back = light.double_sided && shared::random_unit(key, shared::DIM_LIGHT_SIDE) < 0.5f;
    const glm::dvec3 side = back ? -axis : axis;
    e.ray.direction = around(side, std::sqrt(place.x), std::sqrt(1 - place.x), place.y);
    const glm::dvec3 on_light = e.ray.origin + (1 - root) * glm::dvec3(light.edge1) + v * glm::dvec3(light.edge2);
    e.ray.origin = tracer.leave(on_light, side);
    e.flux *= pi * double(light.area) * (light.double_sided ? 2 : 1) * emitted_part(world, light.triangle, on_light);
    e.triangle = light.triangle;
  } else {
    const bool spot = light.type == shared::LIGHT_SPOT;
    const double most = spot ? double(light.cone_versine) : 2, versine = most * place.x;
    const double falloff = spot ? std::clamp((most - versine) * double(light.cone_scale), 0.0, 1.0) : 1;
    e.ray.direction =
        around(spot ? axis : glm::dvec3(0, 1, 0), std::sqrt(versine * (2 - versine)), 1 - versine, place.y);
    e.flux *= 2 * pi * most * falloff * falloff;
  }
  return e;
}

}  // namespace meniscal::reference

#include "host/world/lights.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "host/world/textures.h"

namespace meniscal {
namespace {

struct Powered {
  shared::Light light;
  double power;
};

double mean(const glm::dvec3& c) { return (c.x + c.y + c.z) / 3; }

Powered punctual(const PunctualLight& l, double radius) {
  constexpr double pi = glm::pi<double>();
  shared::Light light{};
  light.position = glm::vec3(l.position);
  light.direction = glm::vec3(l.direction);
  light.intensity = glm::vec3(l.intensity);
  double measure = 4 * pi;  // of directions or area that the intensity fills
  light.type = shared::LIGHT_POINT;
  if (l.type == PunctualLight::Type::directional) {
    light.type = shared::LIGHT_DIRECTIONAL;
    measure = pi * radius * radius;
    const double sine = std::sin(l.angular_diameter / 4), versine = 2 * sine * sine;
    light.cone_versine = static_cast<float>(versine);
    // The normal irradiance is radiance times pi sin^2 of the half angle, the cone's solid angle 2 pi times its
    // versine.
    light.intensity *= static_cast<float>(2 / (2 - versine));
  } else if (l.type == PunctualLight::Type::spot) {
    light.type = shared::LIGHT_SPOT;
    measure = 2 * pi * (1 - std::cos(l.outer_cone));
    const double scale = 1 / std::max(0.001, std::cos(l.inner_cone) - std::cos(l.outer_cone));
    light.cone_scale = static_cast<float>(scale);
    light.cone_versine = static_cast<float>(1 - std::cos(l.outer_cone));
  }
  return {light, mean(glm::dvec3(light.intensity)) * measure};
}

Powered sky(const Environment& environment, double radius) {
  shared::Light light{};
  light.type = shared::LIGHT_ENVIRONMENT;
  return {light, light_of(environment) * glm::pi<double>() * radius * radius};
}

// `part`: of the surface's emission, on average.
Powered emissive(const WorldTriangle& t, std::uint32_t index, const shared::Surface& surface, const glm::dvec3& part) {
  shared::Light light{};
  light.type = shared::LIGHT_AREA;
  light.position = glm::vec3(t.corner[0]);
  light.edge1 = glm::vec3(t.corner[1] - t.corner[0]);
  light.edge2 = glm::vec3(t.corner[2] - t.corner[0]);
  light.direction = glm::vec3(t.geometric);
  light.area = static_cast<float>(t.area);
  light.triangle = index;
  light.intensity = surface.emission;
  light.double_sided = surface.double_sided;
  return {light,
          mean(glm::dvec3(surface.emission) * part) * glm::pi<double>() * t.area * (surface.double_sided ? 2 : 1)};
}

}  // namespace

std::vector<shared::Light> make_lights(const Scene& scene, const World& world, Stages& stages) {
  std::vector<Powered> all;
  for (const PunctualLight& l : scene.lights) all.push_back(punctual(l, world.radius));
  const auto others = std::stable_partition(all.begin(), all.end(), [](const Powered& p) { return is_sun(p.light); });
  if (scene.environment) all.insert(others, sky(*scene.environment, world.radius));
  const Stopwatch watch;
  const std::vector<glm::dvec3> emitted = mean_emission_factors(world);
  if (!emitted.empty()) stages.add("emissive textures", watch.seconds());
  for (std::uint32_t i = 0; i < world.triangles.size(); ++i) {
    const shared::Surface& surface = world.surfaces[world.triangles[i].material];
    if (surface.emission != glm::vec3(0))
      all.push_back(emissive(world.triangles[i], i, surface, emitted.empty() ? glm::dvec3(1) : emitted[i]));
  }
  std::erase_if(all, [](const Powered& p) { return !(p.power > 0); });

  double total = 0;
  for (const Powered& p : all) total += p.power;
  std::vector<shared::Light> lights;
  for (Powered& p : all) {
    p.light.probability = static_cast<float>(p.power / total);
    lights.push_back(p.light);
  }
  return lights;
}

}  // namespace meniscal

#include "host/reference/camera.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>

namespace meniscal::reference {

Path camera_ray(const RenderSettings& settings, const CameraAxes& axes, const glm::dvec2& pixel) {
  const glm::dvec3 step0 = 2.0 / settings.width * axes.right, step1 = -2.0 / settings.height * axes.up;
  const glm::dvec3 offset = pixel.x * step0 - axes.right + pixel.y * step1 + axes.up;
  Path path;
  if (settings.camera.orthographic) {
    path.ray = {axes.origin + offset, axes.forward};
    path.differential.place = {step0, step1};
    return path;
  }
  const glm::dvec3 forward = axes.forward + offset, direction = glm::normalize(forward);
  path.ray = {axes.origin, direction};
  for (int i = 0; const glm::dvec3& step : {step0, step1})
    path.differential.direction[i++] = (step - direction * glm::dot(direction, step)) / glm::length(forward);
  return path;
}

glm::dvec3 direct_irradiance(const Tracer& tracer, const Hit& hit, const glm::dvec3& side, const glm::dvec3& shading,
                             const glm::dvec3& absorption, const shared::RandomKey& key) {
  if (tracer.world().lights.empty()) return glm::dvec3(0);
  const LightSample light = sample_lights(tracer.world(), tracer.world().light_first, hit.point, key, false);
  const double cosine = glm::dot(light.direction, shading);
  if (cosine <= 0 || glm::dot(light.direction, side) <= 0 || light.irradiance == glm::dvec3(0)) return glm::dvec3(0);
  if (!visible(tracer, hit.point, hit.triangle, side, light)) return glm::dvec3(0);
  // Nothing stands between: the light is in the medium that the camera path has come through.
  const double way = std::isfinite(light.distance) ? light.distance : 0;
  return light.irradiance * cosine * glm::exp(-absorption * way);
}

shared::PixelSample trace_camera_path(const Tracer& tracer, const RenderSettings& settings, const CameraAxes& axes,
                                      std::uint32_t pass, const View& view, std::uint32_t x, std::uint32_t y) {
  const World& world = tracer.world();
  shared::RandomKey key{settings.seed, pass, shared::STREAM_CAMERA, y * settings.width + x};
  // From the pixel's centre, in pixels.
  const glm::dvec2 inside =
      double(pixel_jitter(settings, pass)) * (glm::dvec2(shared::pixel_place(key, view.sample)) - 0.5);
  key.stream += view.sample;
  Path path = camera_ray(settings, axes, glm::dvec2(x, y) + 0.5 + inside);
  be_in(path, world, unpack_media(settings.camera_media));
  shared::PixelSample sample{};
  sample.triangle = shared::END_CUT;
  glm::dvec3 emitted(0);
  const std::uint32_t scatterings = view.bounced ? 1 : 0;
  std::uint32_t dimension = shared::DIM_FIRST_BOUNCE, scattered = 0;
  bool first = true;
  for (std::uint32_t met = 0; met <= settings.specular_bounces;) {  // specular surfaces since the last diffuse one
    auto hit = tracer.closest(path.ray, std::numeric_limits<double>::infinity(), path.triangle);
    if (!hit) {
      sample.triangle = shared::END_ESCAPED;
      break;
    }
    absorb(path, hit->t);
    const WorldTriangle& triangle = world.triangles[hit->triangle];
    transfer(path.differential, path.ray.direction, hit->t, triangle.geometric);
    const shared::Surface surface = shade(world, *hit);
    const bool front = glm::dot(triangle.geometric, path.ray.direction) < 0;
    if (first) {
      sample.depth = static_cast<float>(hit->t);
      sample.meniscus = triangle.meniscus ? 1.0f : 0.0f;
      first = false;
    }
    const glm::dvec3 throughput = path.throughput * path.radiance_scale;
    if (front || surface.double_sided) emitted += throughput * glm::dvec3(surface.emission);
    if (pass_straight(path, *hit, tracer)) continue;
    const bool specular = double(shared::random_unit(key, dimension)) < double(surface.specular);
    const float choice = shared::random_unit(key, dimension + 1);
    dimension += shared::BOUNCE_DIMENSIONS;
    if (specular) {
      if (met++ == settings.specular_bounces) break;
      const std::uint32_t way =
          scattered == 0 ? shared::branch_way(view.branch, sample.split, choice) : shared::WAY_BY_ROULETTE;
      const double reflectance = scatter_specular(path, *hit, surface, tracer,
                                                  way == shared::WAY_REFLECTED ? 0
                                                  : way == shared::WAY_THROUGH ? 0.99999994
                                                                               : double(choice));
      if (scattered == 0 && reflectance > 0 && reflectance < 1) {
        path.throughput *= double(shared::way_weight(view.branch, sample.split, way, static_cast<float>(reflectance)));
        if (way == shared::WAY_REFLECTED) emitted = glm::dvec3(0);
        sample.split = shared::next_split(view.branch, sample.split, way);
      }
      continue;
    }
    const glm::dvec3 side = front ? triangle.geometric : -triangle.geometric;
    const glm::dvec3 shading = front ? hit->shading : -hit->shading;
    if (scattered < scatterings) {
      const std::uint32_t numbers = shared::DIM_FIRST_SCATTERING + shared::SCATTERING_DIMENSIONS * scattered + 1;
      path.throughput *= glm::dvec3(surface.albedo);
      const bool goes_on =
          scatter_diffusely(tracer, path, *hit, side, glm::dot(shading, side) > 0 ? shading : side,
                            {double(shared::random_unit(key, numbers)), double(shared::random_unit(key, numbers + 1))});
      if (!goes_on || surface.albedo == glm::vec3(0)) break;
      ++scattered;
      met = 0;
      continue;
    }
    // Discs are filters as wide as a pixel: they are gathered at its centre, however its rays are spread.
    glm::dvec3 shift = -inside.x * path.differential.place[0] - inside.y * path.differential.place[1];
    if (scattered > 0 || settings.caustics.discs.round() || !(glm::length(shift) < most_shift(settings)))
      shift = glm::dvec3(0);
    sample.position = glm::vec3(hit->point + shift);
    sample.normal = glm::vec3(side);
    sample.albedo = surface.albedo;
    sample.triangle = hit->triangle;
    sample.weight = glm::vec3(throughput * glm::dvec3(surface.albedo) * glm::one_over_pi<double>());
    sample.direct = glm::vec3(direct_irradiance(tracer, *hit, side, shading, path.absorption, key));
    break;
  }
  // The paths that end at the first diffuse surface have it; what the next one sees of lights is direct light there.
  if (view.bounced) emitted = glm::dvec3(0);
  sample.emitted = glm::vec3(emitted);
  if (shared::branch_ends_empty(view.branch, sample.split)) {
    sample.triangle = shared::END_DROPPED;
    sample.weight = sample.emitted = glm::vec3(0);
  }
  return sample;
}

}  // namespace meniscal::reference

#include "host/reference/path_tracing.h"

#include <glm/gtc/constants.hpp>
#include <limits>

#include "host/reference/sky.h"

namespace meniscal::reference {

CameraSample trace_whole_path(const Tracer& tracer, const RenderSettings& settings, const CameraAxes& axes,
                              std::uint32_t pass, std::uint32_t index, std::uint32_t x, std::uint32_t y) {
  const World& world = tracer.world();
  shared::RandomKey key{settings.seed, pass, shared::STREAM_CAMERA, y * settings.width + x};
  const glm::dvec2 place(shared::pixel_place(key, index));
  Path path = camera_ray(settings, axes, glm::dvec2(x, y) + place);
  be_in(path, world, unpack_media(settings.camera_media));
  CameraSample result;
  shared::PixelSample& sample = result.pixel;
  sample.triangle = shared::END_ESCAPED;
  glm::dvec3 emitted(0);
  std::uint32_t met = 0, scattered = 0;  // specular surfaces since the last diffuse one; diffuse ones
  Scattering scattering{.goes_on = true};
  bool passed = false;  // straight through a surface, since the last diffuse one
  for (bool first = true; met <= settings.specular_bounces; first = false) {
    auto hit = tracer.closest(path.ray, std::numeric_limits<double>::infinity(), path.triangle);
    // What a diffuse surface sees of the lights without anything between, it was told when it asked them; by its lobe
    // it is both asked and seen.
    const auto part = [&](double asked_pdf) {
      if (scattered == 0 || met > 0 || passed) return 1.0;
      return scattering.by_lobe ? balance(scattering.pdf, asked_pdf) : 0.0;
    };
    if (!hit) {
      const SkySample beyond = sky(world, path.ray.direction);
      emitted += path.throughput * path.radiance_scale * beyond.radiance * part(beyond.pdf);
      break;
    }
    absorb(path, hit->t);
    const WorldTriangle& triangle = world.triangles[hit->triangle];
    const shared::Surface surface = shade(world, *hit);
    const bool front = glm::dot(triangle.geometric, path.ray.direction) < 0;
    if (first) {
      sample.depth = static_cast<float>(hit->t);
      sample.meniscus = triangle.meniscus ? 1.0f : 0.0f;
    }
    if (front || surface.double_sided)
      emitted += path.throughput * path.radiance_scale * glm::dvec3(surface.emission) *
                 part(area_light_pdf(world, hit->triangle, path.ray.origin, hit->t,
                                     std::abs(glm::dot(triangle.geometric, path.ray.direction))));
    if (pass_straight(path, *hit, tracer)) {
      passed = true;
      continue;
    }

    // Numbers of its own for each surface on the way.
    key.stream = shared::STREAM_CAMERA + index + 0x10000u * (scattered * (settings.specular_bounces + 1) + met);
    const auto number = [&](std::uint32_t dimension) { return double(shared::random_unit(key, dimension)); };
    if (meets_specular(path, *hit, surface, number(shared::DIM_FIRST_BOUNCE))) {
      if (met++ < settings.specular_bounces)
        scatter_specular(path, *hit, surface, tracer, number(shared::DIM_FIRST_BOUNCE + 1),
                         {number(shared::DIM_FIRST_FACET), number(shared::DIM_FIRST_FACET + 1)});
      continue;
    }
    if (scattered > settings.diffuse_bounces) break;  // the last one looked for caustics only
    const DiffusePoint point(world, *hit, surface, path.ray.direction);
    const glm::dvec3 throughput = path.throughput * (path.radiance_scale / path.let_through);
    const glm::dvec3 weight = throughput * glm::dvec3(surface.albedo) * glm::one_over_pi<double>();
    const Direct direct = ask_lights(tracer, point, path.absorption, Lobes::both, key);
    if (scattered == 0) {
      sample.position = glm::vec3(hit->point);
      sample.normal = glm::vec3(point.side);
      sample.albedo = surface.albedo;
      sample.triangle = hit->triangle;
      sample.weight = glm::vec3(weight);
      sample.direct = glm::vec3(direct.irradiance);
      result.gloss.direct = glm::vec3(throughput * direct.beyond_lambert);
    } else {
      emitted += weight * direct.irradiance + throughput * direct.beyond_lambert;
    }
    ++scattered;
    met = 0;
    passed = false;
    const std::uint32_t numbers = shared::DIM_FIRST_SCATTERING + 1;
    scattering = scatter(tracer, path, point, glm::dot(point.shading, point.side) > 0 ? point.shading : point.side,
                         Lobes::both, number(numbers + 2), {number(numbers), number(numbers + 1)});
    if (!scattering.goes_on) break;
  }
  sample.emitted = glm::vec3(emitted);
  return result;
}

}  // namespace meniscal::reference

#include "host/reference/camera.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>

#include "host/reference/sky.h"
#include "shaders/shared/material.h"

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

Direct ask_lights(const Tracer& tracer, const DiffusePoint& point, const glm::dvec3& absorption,
                  std::optional<Lobes> bounced, const shared::RandomKey& key) {
  Direct direct;
  const World& world = tracer.world();
  const std::size_t asked = std::min<std::size_t>(world.lights.size(), shared::LIGHTS_ASKED);
  for (std::uint32_t i = 0; i < asked; ++i) {
    const LightSample light = choose_light(world, point.hit.point, point.shading, key, i);
    const double cosine = glm::dot(light.direction, point.shading);
    if (cosine <= 0 || glm::dot(light.direction, point.side) <= 0 || light.irradiance == glm::dvec3(0)) continue;
    if (light.triangle == point.hit.triangle) continue;  // by rounding
    if (!visible(tracer, point.hit.point, point.hit.triangle, point.side, light)) continue;
    // Nothing stands between: the light is in the medium that the camera path has come through.
    const double way = std::isfinite(light.distance) ? light.distance : 0;
    const glm::dvec3 irradiance = light.irradiance * cosine * glm::exp(-absorption * way);
    direct.irradiance += irradiance;
    if (!point.glossy) continue;
    const double other = bounced ? scattering_pdf(point, *bounced, light.direction) : 0;
    const double own = asked_pdf(world, light, point.hit.point), part = own > 0 ? balance(own, other) : 1;
    direct.beyond_lambert +=
        irradiance * beyond_lambert(point.face, glm::dvec3(point.surface.albedo), light.direction, part);
  }
  return direct;
}

namespace {

// From the pixel's centre, in pixels.
glm::dvec2 place_in_pixel(const RenderSettings& settings, const shared::RandomKey& key, std::uint32_t sample) {
  return double(pixel_jitter(settings, key.pass)) * (glm::dvec2(shared::pixel_place(key, sample)) - 0.5);
}

// The way of a path at a mirror's face that divides the light: see branches.h. True where it is reflected.
bool divide(Path& path, shared::PixelSample& sample, const shared::Surface& surface, const Hit& hit,
            std::uint32_t branch, float random, float coin) {
  const glm::vec3 face =
      shared::mirror_reflectance(surface, static_cast<float>(std::abs(glm::dot(path.ray.direction, hit.shading))));
  const float probability = shared::mirror_probability(surface, face);
  if (!(probability > 0 && probability < 1)) return meets_specular(path, hit, surface, random);
  const std::uint32_t way = shared::branch_way(branch, sample.split, coin);
  path.throughput *= double(shared::way_weight(branch, sample.split, way, probability));
  sample.split = shared::next_split(branch, sample.split, way);
  return meets_specular(path, hit, surface, double(shared::way_number(way, random)));
}

}  // namespace

CameraSample trace_camera_path(const Tracer& tracer, const RenderSettings& settings, const CameraAxes& axes,
                               std::uint32_t pass, const View& view, std::uint32_t x, std::uint32_t y) {
  const World& world = tracer.world();
  shared::RandomKey key{settings.seed, pass, shared::STREAM_CAMERA, y * settings.width + x};
  const glm::dvec2 inside = place_in_pixel(settings, key, view.sample);
  key.stream += view.sample;
  const auto number = [&](std::uint32_t dimension) { return double(shared::random_unit(key, dimension)); };
  Path path = camera_ray(settings, axes, glm::dvec2(x, y) + 0.5 + inside);
  be_in(path, world, unpack_media(settings.camera_media));
  CameraSample result;
  shared::PixelSample& sample = result.pixel;
  shared::PixelGloss& gloss = result.gloss;
  gloss.scattered = 1;
  sample.triangle = shared::END_CUT;
  glm::dvec3 emitted(0);
  std::uint32_t dimension = shared::DIM_FIRST_BOUNCE;
  Scattering bounce{.goes_on = view.bounced};  // at the first diffuse surface of a bounced view
  bool bounced = false, first = true;
  bool straight = false;  // nothing was met since the bounce
  // Highlights are another pass': of a path that went through all it met, the lights that it sees at once in a
  // meniscus.
  bool sees_highlights = settings.highlights != shared::HIGHLIGHTS_NONE && !view.bounced, in_meniscus = false;
  // Of what a bounced path sees at once of a light, the surface that it left has asked it itself.
  const auto part = [&](double asked_pdf) {
    if (!view.bounced) return 1.0;
    return straight && bounce.by_lobe ? balance(bounce.pdf, asked_pdf) : 0.0;
  };
  for (std::uint32_t met = 0; met <= settings.specular_bounces;) {  // specular surfaces since the last diffuse one
    auto hit = tracer.closest(path.ray, std::numeric_limits<double>::infinity(), path.triangle);
    if (!hit) {
      sample.triangle = shared::END_ESCAPED;
      const SkySample beyond = sky(world, path.ray.direction, in_meniscus);
      emitted += path.throughput * path.radiance_scale * beyond.radiance * part(beyond.pdf);
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
    const bool theirs = in_meniscus && triangle.light > 0 && settings.highlights == shared::HIGHLIGHTS_ALL;
    if ((front || surface.double_sided) && !theirs)
      emitted += throughput * glm::dvec3(surface.emission) *
                 part(area_light_pdf(world, hit->triangle, path.ray.origin, hit->t,
                                     std::abs(glm::dot(triangle.geometric, path.ray.direction))));
    straight = in_meniscus = false;
    if (pass_straight(path, *hit, tracer)) continue;
    const bool own_way = bounced;  // by roulette
    const double random = number(dimension), coin = number(dimension + 1);
    const glm::dvec2 facet{number(shared::DIM_FIRST_FACET + dimension),
                           number(shared::DIM_FIRST_FACET + dimension + 1)};
    dimension += shared::BOUNCE_DIMENSIONS;
    const std::uint32_t branch = own_way ? shared::BRANCH_ROULETTE : view.branch;
    float split = sample.split;
    const bool divided = surface.kind == shared::SPECULAR_MIRROR;
    const bool specular = divided && !own_way ? divide(path, sample, surface, *hit, branch, static_cast<float>(random),
                                                       static_cast<float>(coin))
                                              : meets_specular(path, *hit, surface, random);
    if (specular) {
      if (met++ == settings.specular_bounces) break;
      sees_highlights = sees_highlights && shared::shows_highlights(surface);
      in_meniscus = sees_highlights && triangle.meniscus;
      if (in_meniscus) sample.highlighted = 1;
      const std::uint32_t way = shared::branch_way(branch, split, static_cast<float>(coin));
      const double choice = double(shared::way_number(way, static_cast<float>(coin)));
      const double reflectance = scatter_specular(path, *hit, surface, tracer, choice, facet);
      const bool through = (glm::dot(path.ray.direction, triangle.geometric) < 0) == front;
      sees_highlights = sees_highlights && (through || reflectance >= 1);
      if (!own_way && reflectance > 0 && reflectance < 1) {
        path.throughput *= double(shared::way_weight(branch, split, way, static_cast<float>(reflectance)));
        sample.split = shared::next_split(branch, split, way);
      }
      if (sample.split != split && way == shared::WAY_REFLECTED) emitted = glm::dvec3(0);
      continue;
    }
    const DiffusePoint point(world, *hit, surface, path.ray.direction);
    if (view.bounced && !bounced) {
      const std::uint32_t numbers = shared::DIM_FIRST_SCATTERING + 1;
      const glm::dvec3 normal = glm::dot(point.shading, point.side) > 0 ? point.shading : point.side;
      bounce = scatter(tracer, path, point, normal, bounced_lobes(settings), number(numbers + 2),
                       {number(numbers), number(numbers + 1)});
      if (!bounce.goes_on) break;
      gloss.scattered = static_cast<float>(bounce.by_lobe ? 0 : 1 / bounce.passed);
      bounced = straight = true;
      met = 0;
      continue;
    }
    // Discs are filters as wide as a pixel: they are gathered at its centre, however its rays are spread.
    glm::dvec3 shift = -inside.x * path.differential.place[0] - inside.y * path.differential.place[1];
    if (bounced || !carries_differentials(settings) || !(glm::length(shift) < most_shift(settings)))
      shift = glm::dvec3(0);
    const Direct direct =
        ask_lights(tracer, point, path.absorption,
                   settings.bounces_gloss && !bounced ? std::optional(bounced_lobes(settings)) : std::nullopt, key);
    const glm::dvec3 arriving = path.throughput * (path.radiance_scale / path.let_through);
    sample.position = glm::vec3(hit->point + shift);
    sample.normal = glm::vec3(point.side);
    sample.albedo = surface.albedo;
    sample.triangle = hit->triangle;
    sample.weight = glm::vec3(arriving * glm::dvec3(surface.albedo) * glm::one_over_pi<double>());
    sample.direct = glm::vec3(direct.irradiance);
    if (point.glossy) {
      gloss.reflects = 1;
      gloss.normal = glm::vec3(point.face.normal);
      gloss.outgoing = glm::vec3(point.face.outgoing);
      gloss.alpha = surface.alpha, gloss.f0 = surface.f0, gloss.f90 = surface.f90;
      gloss.throughput = glm::vec3(arriving);
      gloss.direct = glm::vec3(arriving * direct.beyond_lambert);
    }
    break;
  }
  sample.emitted = glm::vec3(emitted);
  if (shared::branch_ends_empty(view.branch, sample.split)) {
    sample.triangle = shared::END_DROPPED;
    sample.weight = sample.emitted = glm::vec3(0);
    gloss = {};
  }
  return result;
}

}  // namespace meniscal::reference

#include "host/reference/photons.h"

namespace meniscal::reference {
namespace {

// A point of the stratum, uniform by area: the Sobol point's first number picks the triangle, what is left of it and
// the second number the place.
Hit start_point(const World& world, const Stratum& stratum, const shared::RandomKey& key) {
  const shared::uvec2 sobol = shared::sobol_point(key);
  const Picked picked = pick(world.cdf, stratum.first, stratum.count, sobol.x);
  const std::uint32_t index = world.targets[stratum.first + picked.index];
  const double root = std::sqrt(picked.rest), v = root * double(shared::unit_float(sobol.y));
  const double weight[3] = {root - v, 1 - root, v};
  Hit hit{0, index, glm::dvec3(0), glm::dvec3(0)};
  for (int k = 0; k < 3; ++k) {
    hit.point += weight[k] * world.triangles[index].corner[k];
    hit.shading += weight[k] * world.triangles[index].normal[k];
  }
  hit.shading = glm::normalize(hit.shading);
  return hit;
}

// A path that is about to meet its target: at `hit`, lit, or not.
struct Start {
  Path path;
  Hit hit;
  std::uint32_t end;  // END_CUT: goes on
};

// From a point of the target: asks the light.
Start start_on_target(const Tracer& tracer, const Stratum& stratum, std::uint32_t started, const shared::RandomKey& key,
                      const glm::dvec3& shift) {
  const World& world = tracer.world();
  Start start{{}, start_point(world, stratum, key), shared::END_CUT};
  Hit& hit = start.hit;
  hit.point += shift;
  const WorldTriangle& triangle = world.triangles[hit.triangle];
  const LightSample light = sample_light(world, hit.point, key);
  const double cosine = glm::dot(light.direction, triangle.geometric);
  Path& path = start.path;
  path.ray = {hit.point, -light.direction};
  path.triangle = hit.triangle;
  path.throughput = light.irradiance * std::abs(cosine) * (stratum.area / started);
  path.differential = start_differential(triangle.geometric, path.ray.direction, light.distance);
  if (light.irradiance == glm::dvec3(0) ||
      !visible(tracer, hit.point, hit.triangle, cosine > 0 ? triangle.geometric : -triangle.geometric, light)) {
    start.end = shared::END_BLOCKED;
  } else if (cosine < 0 && std::isfinite(light.distance)) {
    path.absorption = glm::dvec3(world.surfaces[triangle.material].absorption);
    absorb(path, light.distance);
  }
  return start;
}

// From the light's view: looks for the target.
Start start_in_view(const Tracer& tracer, const Stratum& stratum, std::uint32_t started, const shared::RandomKey& key,
                    const glm::dvec3& shift) {
  const World& world = tracer.world();
  const shared::uvec2 sobol = shared::sobol_point(key);
  const LightView& view = *stratum.view;
  const glm::dvec3 origin =
      view.corner + double(shared::unit_float(sobol.x)) * view.u + double(shared::unit_float(sobol.y)) * view.v + shift;
  const LightSample light = sample_light(world, origin, key);
  Start start{{}, {0, no_triangle, origin, glm::dvec3(0)}, shared::END_DROPPED};
  Path& path = start.path;
  path.ray = {origin, -light.direction};
  path.throughput = light.irradiance * (view.area / started);
  path.differential = start_differential(path.ray.direction, path.ray.direction, light.distance);
  const auto hit = tracer.closest(path.ray, std::numeric_limits<double>::infinity(), no_triangle);
  if (!hit) return start;
  const WorldTriangle& triangle = world.triangles[hit->triangle];
  start.hit = *hit;
  transfer(path.differential, path.ray.direction, hit->t, triangle.geometric);
  // What the light sees first may be another stratum's, or nothing that photons start on.
  const bool target = world.surfaces[triangle.material].specular > 0 &&
                      triangle.meniscus == (stratum.stream == shared::STREAM_TARGETED);
  if (target) start.end = shared::END_CUT;
  return start;
}

}  // namespace

Photon trace_photon(const Tracer& tracer, const Stratum& stratum, const PhotonSettings& settings, std::uint32_t index,
                    const Perturbation& perturbation) {
  const World& world = tracer.world();
  const shared::RandomKey key{settings.seed, settings.pass, stratum.stream, index};
  const auto decide = [&](std::uint32_t dimension) {
    return double(shared::random_unit(key, dimension)) + perturbation.roulette;
  };

  auto [path, hit, end] = stratum.view ? start_in_view(tracer, stratum, settings.started, key, perturbation.start)
                                       : start_on_target(tracer, stratum, settings.started, key, perturbation.start);
  Photon photon{hit.point, {}, path.throughput, path.throughput, end};
  for (std::uint32_t bounce = 0; bounce <= settings.specular_bounces && photon.end == shared::END_CUT; ++bounce) {
    const std::uint32_t dimension = shared::DIM_FIRST_BOUNCE + shared::BOUNCE_DIMENSIONS * bounce;
    const WorldTriangle& triangle = world.triangles[hit.triangle];
    if (decide(dimension) >= double(world.surfaces[triangle.material].specular)) {
      const bool arrived_in_front = glm::dot(triangle.geometric, path.ray.direction) < 0;
      photon.position = hit.point;
      photon.disc = make_footprint(path.differential, arrived_in_front ? triangle.geometric : -triangle.geometric,
                                   settings.discs.reach, settings.discs.narrowest, settings.discs.widest);
      // Scattered diffusely by its own target: it has met no specular surface and is direct light.
      photon.end = bounce > 0 ? hit.triangle : shared::END_DROPPED;
      break;
    }
    if (bounce == settings.specular_bounces) break;
    scatter_specular(path, hit, tracer, decide(dimension + 1));
    const auto next = tracer.closest(path.ray, std::numeric_limits<double>::infinity(), path.triangle);
    if (!next) {
      photon.end = shared::END_ESCAPED;
      break;
    }
    absorb(path, next->t);
    transfer(path.differential, path.ray.direction, next->t, world.triangles[next->triangle].geometric);
    hit = *next;
  }
  photon.flux = path.throughput;
  return photon;
}

}  // namespace meniscal::reference

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

}  // namespace

Photon trace_photon(const Tracer& tracer, const Stratum& stratum, const PhotonSettings& settings, std::uint32_t index,
                    const Perturbation& perturbation) {
  const World& world = tracer.world();
  const shared::RandomKey key{settings.seed, settings.pass, stratum.stream, index};
  const auto decide = [&](std::uint32_t dimension) {
    return double(shared::random_unit(key, dimension)) + perturbation.roulette;
  };

  Hit hit = start_point(world, stratum, key);
  hit.point += perturbation.start;
  const glm::dvec3 geometric = world.triangles[hit.triangle].geometric;
  const LightSample light = sample_light(world, hit.point, key);
  const double cosine = glm::dot(light.direction, geometric);
  const glm::dvec3 flux = light.irradiance * (stratum.area / settings.started);
  Photon photon{hit.point, {}, flux, flux, shared::END_DROPPED};
  if (decide(shared::DIM_COSINE) >= std::abs(cosine)) return photon;
  photon.end = shared::END_BLOCKED;
  if (light.irradiance == glm::dvec3(0)) return photon;
  if (!visible(tracer, hit.point, hit.triangle, cosine > 0 ? geometric : -geometric, light)) return photon;

  Path path{{hit.point, -light.direction}, hit.triangle, photon.flux};
  if (cosine < 0 && std::isfinite(light.distance)) {
    path.absorption = glm::dvec3(world.surfaces[world.triangles[hit.triangle].material].absorption);
    absorb(path, light.distance);
  }
  photon.entered = path.throughput;
  path.differential = start_differential(geometric, path.ray.direction, light.distance);
  photon.end = shared::END_CUT;
  for (std::uint32_t bounce = 0; bounce <= settings.specular_bounces; ++bounce) {
    const std::uint32_t dimension = shared::DIM_FIRST_BOUNCE + shared::BOUNCE_DIMENSIONS * bounce;
    const WorldTriangle& triangle = world.triangles[hit.triangle];
    if (decide(dimension) >= double(world.surfaces[triangle.material].specular)) {
      const bool arrived_in_front = glm::dot(triangle.geometric, path.ray.direction) < 0;
      // Starts are kept with probability cosine: so much further apart.
      const double spacing = std::sqrt(stratum.area / (settings.started * std::max(std::abs(cosine), 1e-6)));
      photon.position = hit.point;
      photon.disc = make_footprint(path.differential, arrived_in_front ? triangle.geometric : -triangle.geometric,
                                   settings.discs.spread * spacing, settings.discs.narrowest, settings.discs.widest);
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

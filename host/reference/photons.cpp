#include "host/reference/photons.h"

#include <algorithm>

#include "host/reference/emission.h"
#include "host/reference/scattering.h"
#include "shaders/shared/geometry.h"
#include "shaders/shared/starts.h"

namespace meniscal::reference {
namespace {

// A path that is about to meet its target: at `hit`, lit, or not.
struct Start {
  Path path;
  Hit hit;
  std::uint32_t map;
  std::uint32_t end;  // END_CUT: goes on
};

// A point of the beam's targets, uniform by area: the start's first number picks the triangle, what is left of it and
// the second number the place.
Hit start_point(const World& world, const shared::Beam& beam, const shared::uvec2& bits) {
  const Picked picked = pick(world.cdf, beam.target_first, beam.target_count, bits.x);
  const std::uint32_t index = world.targets[beam.target_first + picked.index];
  const double root = std::sqrt(picked.rest), v = root * double(shared::unit_float(bits.y));
  const double weight[3] = {root - v, 1 - root, v};
  Hit hit{0, index, glm::dvec3(0), glm::dvec3(0)};
  for (int k = 0; k < 3; ++k) {
    hit.point += weight[k] * world.triangles[index].corner[k];
    hit.shading += weight[k] * world.triangles[index].normal[k];
  }
  hit.shading = glm::normalize(hit.shading);
  return hit;
}

// From a point of the target: asks the light. `area`: that the photon stands for, m2.
Start start_on_target(const Tracer& tracer, const shared::Beam& beam, double area, const shared::uvec2& bits,
                      const shared::RandomKey& key, const glm::dvec3& shift) {
  const World& world = tracer.world();
  Start start{{}, start_point(world, beam, bits), beam.map, shared::END_CUT};
  Hit& hit = start.hit;
  hit.point += shift;
  const WorldTriangle& triangle = world.triangles[hit.triangle];
  const LightSample light = sample_lights(world, beam.light_first, hit.point, key, world.extended_lights);
  const double cosine = glm::dot(light.direction, triangle.geometric);
  Path& path = start.path;
  path.ray = {hit.point, -light.direction};
  path.triangle = hit.triangle;
  path.throughput = light.irradiance * std::abs(cosine) * area;
  path.differential = start_differential(triangle.geometric, path.ray.direction, light.distance);
  if (light.extent > 0) path.by_light = light_differential(light.normal, light.extent, path.ray.direction);
  if (path.throughput == glm::dvec3(0) || light.triangle == hit.triangle ||
      !visible(tracer, hit.point, hit.triangle, cosine > 0 ? triangle.geometric : -triangle.geometric, light)) {
    start.end = shared::END_BLOCKED;
  } else {
    be_in(path, world, unpack_media(light.media));
    if (std::isfinite(light.distance)) absorb(path, light.distance);
  }
  return start;
}

// Follows a path from a light to what it meets first. `map`: the global one, or that of one that meets nothing that
// photons start on.
Start meet_first(const Tracer& tracer, const Path& path, std::uint32_t map) {
  const World& world = tracer.world();
  Start start{path, {0, no_triangle, path.ray.origin, glm::dvec3(0)}, map, shared::END_DROPPED};
  if (path.throughput == glm::dvec3(0)) return start;
  const auto hit = tracer.closest(path.ray, std::numeric_limits<double>::infinity(), path.triangle);
  if (!hit) return start;
  const WorldTriangle& triangle = world.triangles[hit->triangle];
  start.hit = *hit;
  absorb(start.path, hit->t);
  for (Differential* d : {&start.path.differential, &start.path.by_light})
    transfer(*d, path.ray.direction, hit->t, triangle.geometric);
  if (map != shared::MAP_GLOBAL && world.surfaces[triangle.material].specular == 0) return start;
  if (map != shared::MAP_GLOBAL) start.map = triangle.meniscus ? shared::MAP_TARGETED : shared::MAP_CAUSTIC;
  start.end = shared::END_CUT;
  return start;
}

// Before all of the scene, on the way through a place in the view.
Start start_in_view(const Tracer& tracer, const shared::Beam& beam, double area, const shared::uvec2& bits,
                    const shared::RandomKey& key, const glm::dvec3& shift) {
  const World& world = tracer.world();
  const glm::dvec3 through = glm::dvec3(beam.corner) + double(shared::unit_float(bits.x)) * glm::dvec3(beam.u) +
                             double(shared::unit_float(bits.y)) * glm::dvec3(beam.v) + shift;
  const shared::uvec2 more = shared::sobol_point_beyond(key);
  const glm::dvec2 place(double(shared::unit_float(more.x)), double(shared::unit_float(more.y)));
  const LightSample light = sample_light(world, beam.light, 1, through, place);
  const glm::dvec3 axis = glm::normalize(glm::dvec3(world.lights[beam.light].direction));
  const double cosine = -glm::dot(light.direction, axis);
  const double before = (1.01 * world.radius + glm::dot(through, axis)) / cosine;
  Path path;
  path.ray = {through + before * light.direction, -light.direction};
  path.throughput = light.irradiance * cosine * std::max(area, 0.0);
  path.differential = start_differential(-axis, path.ray.direction, light.distance);
  path.by_light = light_differential(light.normal, light.extent, path.ray.direction);
  for (int i = 0; i < 2; ++i) path.by_light.place[i] = -before * path.by_light.direction[i];
  return meet_first(tracer, path, beam.map);
}

// From one of the lights: looks for what it meets. `part`: of all photons.
Start start_on_light(const Tracer& tracer, double part, std::uint32_t map, const shared::vec2& place,
                     const shared::RandomKey& key, const glm::dvec3& shift) {
  const Emission emission = emit(tracer, glm::dvec2(place), key);
  Path path;
  path.ray = {emission.ray.origin + shift, emission.ray.direction};
  path.triangle = emission.triangle;
  path.throughput = emission.flux * part;
  be_in(path, tracer.world(), unpack_media(emission.media));
  return meet_first(tracer, path, map);
}

Start start_photon(const Tracer& tracer, const shared::Beam& beam, const shared::RandomKey& key,
                   const glm::dvec3& shift) {
  const shared::uvec2 bits = shared::start_bits(key, beam.start, beam.extent);
  const shared::vec2 place(shared::unit_float(bits.x), shared::unit_float(bits.y));
  const double area = double(beam.power) * double(shared::window_weight(place, beam.own, beam.own_fade) -
                                                  shared::window_weight(place, beam.finer, beam.finer_fade));
  if (beam.kind == shared::START_ON_LIGHTS) return start_on_light(tracer, area, beam.map, place, key, shift);
  return beam.kind == shared::START_IN_VIEW ? start_in_view(tracer, beam, area, bits, key, shift)
                                            : start_on_target(tracer, beam, area, bits, key, shift);
}

// Half-widths of a disc's two parts: in the facet that the path started on, m, and on its light, in units of its
// extent.
struct Reach {
  double start, light;
};

// Paths from an extended light lie in four dimensions, two of the start and two of the point on the light. Distances
// there go as the geometric mean of those between starts and the light's image where the photon lands (`image`: its
// area, m2), if that is wider. The factors were measured with lights of 0.6 to 6 degrees and 8,000 to 100,000 photons.
Reach disc_reach(double reach, double image) {
  if (!(image > 0)) return {reach, 0};
  const double extent = std::sqrt(image);
  return {std::max(reach, 2 * std::sqrt(reach * extent)), 0.5 * std::min(std::sqrt(reach / extent), 1.0)};
}

}  // namespace

Photon trace_photon(const Tracer& tracer, const RenderSettings& settings, std::uint32_t pass, std::uint32_t index,
                    const Perturbation& perturbation, bool global) {
  const World& world = tracer.world();
  const PhotonSet& set = global ? settings.global : settings.caustics;
  const auto beam =
      std::find_if(set.beams.rbegin(), set.beams.rend(), [&](const shared::Beam& b) { return b.first <= index; });
  const std::uint32_t stream =
      (global ? shared::STREAM_GLOBAL : shared::STREAM_BEAM) + static_cast<std::uint32_t>(set.beams.rend() - beam) - 1;
  const shared::RandomKey key{settings.seed, pass, stream, start_index(*beam, index - beam->first)};
  const auto decide = [&](std::uint32_t dimension) {
    return double(shared::random_unit(key, dimension)) + perturbation.roulette;
  };

  Start start = start_photon(tracer, *beam, key, perturbation.start);
  Path& path = start.path;
  Hit& hit = start.hit;
  const std::uint32_t map = start.map;
  Photon photon{
      global ? shared::MAP_GLOBAL : map, hit.point, {}, glm::dvec3(0), path.throughput, path.throughput, 1, start.end};

  std::uint32_t dimension = shared::DIM_FIRST_BOUNCE;
  std::uint32_t met = 0, scattered = 0;  // specular surfaces since the start or the last diffuse one; diffuse ones
  const auto absorb_in = [&](const auto& event) {
    const glm::dvec3 before = path.throughput;
    event();
    photon.absorbed += before - path.throughput;
  };
  const auto go_on = [&] {
    const auto next = tracer.closest(path.ray, std::numeric_limits<double>::infinity(), path.triangle);
    if (!next) {
      photon.end = shared::END_ESCAPED;
      return;
    }
    absorb_in([&] { absorb(path, next->t); });
    for (Differential* d : {&path.differential, &path.by_light})
      transfer(*d, path.ray.direction, next->t, world.triangles[next->triangle].geometric);
    hit = *next;
  };
  for (bool first = true; photon.end == shared::END_CUT; first = false) {
    const bool beams_have_it = first && map == shared::MAP_GLOBAL && settings.integrator != Integrator::ordinary;
    if (!beams_have_it && pass_straight(path, hit, tracer)) {
      go_on();
      continue;
    }
    const shared::Surface surface = shade(world, hit);
    // What is not reflected there first, direct light has.
    const bool certain = first && map != shared::MAP_GLOBAL && settings.integrator != Integrator::ordinary;
    const bool specular = meets_specular(path, hit, surface, decide(dimension), certain);
    const double choice = decide(dimension + 1);
    const glm::dvec2 facet{decide(shared::DIM_FIRST_FACET + dimension),
                           decide(shared::DIM_FIRST_FACET + dimension + 1)};
    dimension += shared::BOUNCE_DIMENSIONS;
    const std::uint32_t numbers = shared::DIM_FIRST_SCATTERING + shared::SCATTERING_DIMENSIONS * scattered;
    // Of the global map's photons: light that is direct, or that the other maps have.
    const bool theirs = global && scattered == 0 && (met == 0 || !set.keeps_caustics);
    const double stops = theirs ? 0
                         : scattered == set.scatterings
                             ? 1
                             : double(shared::storing_probability(surface.albedo + surface.f0));
    // Direct light; or, of photons that set out for the global map, what beams towards the targets have.
    const bool counted_elsewhere = beams_have_it ? specular : first && map != shared::MAP_GLOBAL && !specular;
    if (counted_elsewhere || (theirs && !specular && set.scatterings == 0)) {
      photon.end = shared::END_DROPPED;
      break;
    }
    if (specular) {
      if (met++ == settings.specular_bounces) break;
      absorb_in([&] { scatter_specular(path, hit, surface, tracer, choice, facet); });
    } else {
      const DiffusePoint point(world, hit, surface, path.ray.direction);
      Path next = path;
      const Scattering how = scatter(tracer, next, point, point.side, Lobes::both, decide(numbers + 3),
                                     {decide(numbers + 1), decide(numbers + 2)});
      const glm::dvec3 again = how.goes_on ? next.throughput : glm::dvec3(0);
      if (decide(numbers) < stops) {
        path.throughput /= stops;
        // Of light that others of the map's photons, where there are more bounces, take further.
        if (global) photon.absorbed += path.throughput - again / stops;
        if (global && scattered == set.scatterings) photon.cut = again / stops;
        const Discs discs = pass_discs(set.discs, pass);
        const Reach reach = disc_reach(double(beam->reach), spread(path.by_light));
        photon.disc = make_footprint(
            {{path.differential, discs.shrink * reach.start}, {path.by_light, discs.shrink * reach.light}}, point.side,
            discs.narrowest, discs.widest);
        photon.position = hit.point;
        photon.arrival = shared::unpack_direction(shared::pack_direction(glm::vec3(path.ray.direction)));
        photon.end = hit.triangle;
        break;
      }
      // Where photons are stored, too, those tell what is absorbed.
      if (stops == 0) photon.absorbed += path.throughput - again;
      path = next;
      path.throughput = again / (1 - stops);
      if (!how.goes_on) {
        photon.end = shared::END_ABSORBED;
        break;
      }
      ++scattered;
      met = 0;
    }
    go_on();
  }
  photon.flux = path.throughput;
  photon.let_through = path.let_through;
  if (photon.end == shared::END_CUT) photon.cut = photon.flux;
  return photon;
}

}  // namespace meniscal::reference

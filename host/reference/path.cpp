#include "host/reference/path.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <limits>

#include "host/reference/optics.h"
#include "host/reference/reflection.h"
#include "host/reference/sky.h"
#include "shaders/shared/material.h"
#include "shaders/shared/seen_triangle.h"

namespace meniscal::reference {
namespace {

// The one of the highest rank, of these the last entered: what the path is in. None: air.
const shared::Surface* medium_of(const World& world, const Media& media) {
  const shared::Surface* medium = nullptr;
  for (const std::uint32_t i : media)
    if (!medium || world.surfaces[i].rank >= medium->rank) medium = &world.surfaces[i];
  return medium;
}

// Takes the last one out.
bool erase_last(Media& media, std::uint32_t surface) {
  const auto found = std::find(media.rbegin(), media.rend(), surface);
  if (found == media.rend()) return false;
  media.erase(std::next(found).base());
  return true;
}

// On the two sides of a dielectric surface. The path's own may be wrong: an open sheet of liquid can be gone round.
struct Crossing {
  Media before, beyond;
};
Crossing cross(const World& world, const Media& media, std::uint32_t surface, bool front) {
  Media without = media, with = media;
  const bool within = erase_last(without, surface);
  if (!front || world.surfaces[surface].liquid) {
    if (!within) with.push_back(surface);
    return front ? Crossing{without, with} : Crossing{with, without};
  }
  with.push_back(surface);
  return {media, with};
}

double ior_of(const shared::Surface* medium) { return medium ? double(medium->ior) : 1; }

}  // namespace

Media unpack_media(const glm::uvec4& packed) {
  Media media;
  for (int i = 3; i >= 0; --i)
    if (packed[i] != 0) media.push_back((packed[i] & shared::MEDIUM_SURFACE_MASK) - 1);
  return media;
}

void be_in(Path& path, const World& world, Media media) {
  const shared::Surface* medium = medium_of(world, media);
  path.absorption = medium ? glm::dvec3(medium->absorption) : glm::dvec3(0);
  path.media = std::move(media);
}

bool pass_straight(Path& path, const Hit& hit, const Tracer& tracer) {
  const World& world = tracer.world();
  const WorldTriangle& triangle = world.triangles[hit.triangle];
  if (world.surfaces[triangle.material].kind != shared::SPECULAR_DIELECTRIC) return false;
  const bool front = glm::dot(path.ray.direction, triangle.geometric) < 0;
  const auto [before, beyond] = cross(world, path.media, triangle.material, front);
  if (medium_of(world, before) != medium_of(world, beyond)) return false;
  be_in(path, world, beyond);
  path.ray.origin = tracer.leave(hit.point, front ? -triangle.geometric : triangle.geometric);
  path.triangle = hit.triangle;
  return true;
}

bool meets_specular(Path& path, const Hit& hit, const shared::Surface& surface, double random, bool certain) {
  if (surface.kind != shared::SPECULAR_MIRROR) return random < double(surface.specular);
  const double cosine = std::abs(glm::dot(path.ray.direction, hit.shading));
  const glm::dvec3 reflectance(shared::mirror_reflectance(surface, static_cast<float>(cosine)));
  const double probability = certain ? 1 : double(shared::mirror_probability(surface, glm::vec3(reflectance)));
  const bool specular = random < probability;
  if (specular) path.throughput *= reflectance / probability;
  path.let_through = specular ? 1 : 1 - probability;
  return specular;
}

double scatter_specular(Path& path, const Hit& hit, const shared::Surface& surface, const Tracer& tracer, double random,
                        const glm::dvec2& facet) {
  const World& world = tracer.world();
  const WorldTriangle& triangle = world.triangles[hit.triangle];
  const glm::dvec3 arrival = path.ray.direction;
  const bool front = glm::dot(arrival, triangle.geometric) < 0;
  const glm::dvec3 side = front ? triangle.geometric : -triangle.geometric;
  const bool dielectric = surface.kind == shared::SPECULAR_DIELECTRIC;
  const bool rough = surface.alpha > 0;
  const Crossing crossing =
      dielectric ? cross(world, path.media, triangle.material, front) : Crossing{path.media, path.media};
  const double eta = ior_of(medium_of(world, crossing.before)) / ior_of(medium_of(world, crossing.beyond));

  glm::dvec3 normal = front ? hit.shading : -hit.shading;
  const std::array<Differential*, 2> differentials = {&path.differential, &path.by_light};
  std::array<std::array<glm::dvec3, 2>, 2> dn;  // how the normal changes with each
  for (int i = 0; i < 2; ++i) {
    dn[i] = normal_differential(triangle, hit, *differentials[i]);
    if (!front) dn[i] = {-dn[i][0], -dn[i][1]};
  }
  const auto bend_with_facet = [&] { normal = side, dn = {}; };
  if (glm::dot(arrival, normal) >= 0) bend_with_facet();
  const glm::dvec3 mean = normal;  // of the microfacets
  if (rough) normal = visible_normal(normal, -arrival, double(surface.alpha), facet);

  bool reflected = true;
  double reflectance = 1;
  if (dielectric) {
    reflectance = fresnel_reflectance(-glm::dot(arrival, normal), eta);
    reflected = random < reflectance;
    if (!reflected && !rough && glm::dot(refract(arrival, normal, eta), side) >= 0) {
      bend_with_facet();
      reflected = refracted_cosine(-glm::dot(arrival, side), eta) < 0;
    }
  } else if (surface.kind == shared::SPECULAR_THIN) {
    reflectance = sheet_reflectance(-glm::dot(arrival, normal), double(surface.ior));
    reflected = random < reflectance;
  }
  if (reflected && !rough && glm::dot(reflect(arrival, normal), side) <= 0) bend_with_facet();

  if (reflected) {
    for (int i = 0; i < 2; ++i) reflect(*differentials[i], arrival, normal, dn[i]);
    path.ray.direction = reflect(arrival, normal);
  } else {
    path.throughput *= glm::dvec3(surface.tint);
    if (dielectric) {
      for (int i = 0; i < 2; ++i) refract(*differentials[i], arrival, normal, dn[i], eta);
      path.ray.direction = refract(arrival, normal, eta);
      path.radiance_scale *= eta * eta;
    } else if (rough) {
      // A rough sheet lets light through as it reflects it, to the other side.
      path.ray.direction = reflect(reflect(arrival, normal), mean);
    }
  }
  const glm::dvec3 beyond = reflected ? side : -side;
  if (rough) {
    const bool lost =
        glm::dot(path.ray.direction, beyond) <= 0 || glm::dot(path.ray.direction, mean) * glm::dot(beyond, side) <= 0;
    path.throughput *= lost ? 0 : unhidden(std::abs(glm::dot(path.ray.direction, mean)), double(surface.alpha));
  }
  be_in(path, world, reflected ? crossing.before : crossing.beyond);
  path.ray.direction = glm::normalize(path.ray.direction);
  path.ray.origin = tracer.leave(hit.point, beyond);
  path.triangle = hit.triangle;
  return reflectance;
}

glm::dvec3 around(const glm::dvec3& axis, double sine, double cosine, double turn) {
  const auto [u, v] = tangents(axis);
  return cosine * axis +
         sine * (std::cos(2 * glm::pi<double>() * turn) * u + std::sin(2 * glm::pi<double>() * turn) * v);
}

void absorb(Path& path, double distance) { path.throughput *= glm::exp(-path.absorption * distance); }

LightSample sample_lights(const World& world, std::uint32_t first, const glm::dvec3& point,
                          const shared::RandomKey& key, bool stratified) {
  using shared::DIM_LIGHT, shared::DIM_LIGHT_U, shared::DIM_LIGHT_V, shared::random_unit;
  const shared::uvec2 bits =
      stratified ? shared::sobol_point_beyond(key) : shared::uvec2(shared::random_bits(key, DIM_LIGHT), 0);
  const Picked picked = pick(world.cdf, first, world.lights.size(), bits.x);
  const glm::dvec2 place = stratified ? glm::dvec2(picked.rest, shared::unit_float(bits.y))
                                      : glm::dvec2(random_unit(key, DIM_LIGHT_U), random_unit(key, DIM_LIGHT_V));
  return sample_light(world, picked.index, picked.weight, point, place);
}

LightSample choose_light(const World& world, const glm::dvec3& point, const glm::dvec3& normal,
                         const shared::RandomKey& key, std::uint32_t i) {
  const auto unit = [&](std::uint32_t dimension) {
    return double(shared::unit_float(shared::light_bits(key, dimension, i)));
  };
  const auto count = static_cast<std::uint32_t>(world.lights.size());
  const glm::dvec2 place(unit(shared::DIM_LIGHT_U), unit(shared::DIM_LIGHT_V));
  if (count <= shared::LIGHTS_ASKED) return sample_light(world, i, 1, point, place);
  const std::uint32_t candidates = std::min(count, shared::LIGHT_CANDIDATES);
  double choice = unit(shared::DIM_LIGHT_SIDE), sum = 0, kept = 0;
  LightSample chosen{};
  for (std::uint32_t c = 0; c < candidates; ++c) {
    Picked picked{c, 0, 1};
    if (candidates < count) {
      const std::uint32_t bits = shared::light_bits(key, shared::DIM_LIGHT, i) + c * (0xFFFFFFFFu / candidates);
      picked = pick(world.cdf, world.light_first, count, bits);
      picked.weight /= candidates;
    }
    const LightSample s = sample_light(world, picked.index, picked.weight, point, place);
    const double given =
        (s.irradiance.x + s.irradiance.y + s.irradiance.z) * std::max(glm::dot(s.direction, normal), 0.0);
    if (c == 0) chosen = s;
    if (!(given > 0)) continue;
    sum += given;
    // Keeps one by one number, of which it uses up what the choice so far took.
    const bool taken = choice * sum < given;
    choice = std::clamp(taken ? choice * sum / given : (choice * sum - given) / (sum - given), 0.0, 1.0);
    if (taken) chosen = s, kept = given;
  }
  if (kept > 0) chosen.irradiance *= sum / (kept * shared::LIGHTS_ASKED);
  return chosen;
}

namespace {

shared::SeenTriangle see(const shared::Light& light, const glm::dvec3& point) {
  return shared::see_triangle(glm::vec3(glm::dvec3(light.position) - point), light.edge1, light.edge2);
}

// The solid angle that a point of a seen triangle stands for, 1 / its density, sr.
double angle_of_sample(const shared::SeenTriangle& seen, double area, double distance, double cosine) {
  return seen.angle > 0 ? double(seen.angle) : area * cosine / (distance * distance);
}

}  // namespace

LightSample sample_light(const World& world, std::uint32_t index, double weight, const glm::dvec3& point,
                         const glm::dvec2& place) {
  const shared::Light& light = world.lights[index];
  const glm::dvec3 axis = glm::normalize(glm::dvec3(light.direction));
  LightSample s{-axis, std::numeric_limits<double>::infinity(), glm::dvec3(light.intensity) * weight, no_triangle, {}};
  s.media = light.media;
  if (light.type == shared::LIGHT_DIRECTIONAL || light.type == shared::LIGHT_ENVIRONMENT) {
    const DistantSample distant = sample_distant(world, light, place);
    s.direction = distant.direction;
    s.irradiance = distant.irradiance * weight;
    s.normal = -s.direction;
    s.extent = std::min(std::sqrt(distant.solid_angle * weight), most_extent);
    return s;
  }

  if (light.type == shared::LIGHT_AREA) {
    const shared::SeenTriangle seen = see(light, point);
    glm::dvec3 towards;
    bool missed = false;
    if (seen.angle > 0) {
      const shared::SeenPoint there = shared::sample_seen_triangle(seen, glm::vec3(glm::dvec3(light.position) - point),
                                                                   light.edge1, light.edge2, glm::vec2(place));
      towards = double(there.distance) * glm::dvec3(there.direction);
      missed = there.missed;
    } else {
      const double root = std::sqrt(place.x), v = root * place.y;
      towards = glm::dvec3(light.position) + (1 - root) * glm::dvec3(light.edge1) + v * glm::dvec3(light.edge2) - point;
    }
    s.distance = glm::length(towards);
    s.direction = towards / s.distance;
    s.triangle = light.triangle;
    s.normal = axis;
    const double cosine = -glm::dot(s.direction, axis);
    const bool emits = !missed && (light.double_sided || cosine > 0);
    const double angle = emits ? angle_of_sample(seen, double(light.area), s.distance, std::abs(cosine)) : 0;
    s.irradiance *= angle * emitted_part(world, light.triangle, point + towards);
    s.extent = seen.angle > 0 ? std::min(std::sqrt(double(seen.angle) * weight / std::abs(cosine)), most_extent)
                              : std::sqrt(double(light.area) * weight) / s.distance;
    return s;
  }
  s.distance = glm::length(glm::dvec3(light.position) - point);
  s.direction = (glm::dvec3(light.position) - point) / s.distance;
  s.irradiance /= s.distance * s.distance;
  if (light.type == shared::LIGHT_SPOT) {
    const double cosine = -glm::dot(s.direction, axis);
    const double falloff = std::clamp((double(light.cone_versine) - (1 - cosine)) * double(light.cone_scale), 0.0, 1.0);
    s.irradiance *= falloff * falloff;
  }
  return s;
}

double area_light_pdf(const World& world, std::uint32_t triangle, const glm::dvec3& point, double distance,
                      double cosine) {
  const std::uint32_t index = world.triangles[triangle].light;
  if (index == 0) return 0;
  const shared::Light& light = world.lights[index - 1];
  return double(light.probability) /
         angle_of_sample(see(light, point), world.triangles[triangle].area, distance, cosine);
}

double asked_pdf(const World& world, const LightSample& light, const glm::dvec3& point) {
  if (light.extent == 0) return 0;
  if (light.triangle == no_triangle) return sky(world, light.direction).pdf;
  return area_light_pdf(world, light.triangle, point, light.distance,
                        std::abs(glm::dot(light.normal, light.direction)));
}

bool visible(const Tracer& tracer, const glm::dvec3& point, std::uint32_t triangle, const glm::dvec3& side,
             const LightSample& light) {
  const double reach = light.triangle == no_triangle ? light.distance : light.distance * (1 - 1e-5);
  return !tracer.blocked({tracer.leave(point, side), light.direction}, reach, triangle);
}

Picked pick(const std::vector<std::uint32_t>& cdf, std::uint32_t first, std::size_t count, std::uint32_t bits) {
  const auto begin = cdf.begin() + first, end = begin + static_cast<std::ptrdiff_t>(count);
  bits = std::min(bits, 0xFFFFFFFEu);
  const auto entry = std::upper_bound(begin, end, bits);
  const std::uint32_t start = entry == begin ? 0 : *(entry - 1), width = *entry - start;
  const float rest = std::min(static_cast<float>(bits - start) / static_cast<float>(width), 0.99999994f);
  return {static_cast<std::uint32_t>(entry - begin), double(rest), 0x1p32 / width};
}

}  // namespace meniscal::reference

#include "host/reference/highlights.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <span>

#include "host/reference/coverage.h"
#include "host/reference/materials.h"
#include "shaders/shared/branches.h"
#include "shaders/shared/highlights.h"
#include "shaders/shared/material.h"

namespace meniscal::reference {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Which place of a cell sees what, to first order, by the derivatives of a path that comes from `place` in it, both in
// units of the cell: as if the cell saw a plane.
class Lens {
 public:
  // Of directions, as places on the plane across the ray in the distance 1.
  Lens(const Path& path, const glm::dvec2& place)
      : Lens(path.ray.direction, path.ray.direction, path.differential.direction, place) {
    spread_ += glm::dmat2(shared::LEAST_CELL_ANGLE);
  }
  // Of points in the plane of this normal that the ray meets at a distance.
  Lens(const Path& path, const glm::dvec2& place, double distance, const glm::dvec3& normal)
      : Lens(path.ray.origin + distance * path.ray.direction, normal, transferred(path, distance, normal).place,
             place) {}

  glm::dvec2 place_of(const glm::dvec3& point) const {
    return place_ + glm::inverse(spread_) * in_plane(point - centre_);
  }
  glm::dvec3 seen_from(const glm::dvec2& place) const {
    const glm::dvec2 at = spread_ * (place - place_);
    return centre_ + at.x * axes_[0] + at.y * axes_[1];
  }

 private:
  Lens(const glm::dvec3& centre, const glm::dvec3& normal, const std::array<glm::dvec3, 2>& moved,
       const glm::dvec2& place)
      : centre_(centre), axes_(tangents(normal)), spread_(in_plane(moved[0]), in_plane(moved[1])), place_(place) {}
  static Differential transferred(const Path& path, double distance, const glm::dvec3& normal) {
    Differential d = path.differential;
    transfer(d, path.ray.direction, distance, normal);
    return d;
  }
  glm::dvec2 in_plane(const glm::dvec3& v) const { return {glm::dot(axes_[0], v), glm::dot(axes_[1], v)}; }

  glm::dvec3 centre_;
  std::array<glm::dvec3, 2> axes_;
  glm::dmat2 spread_;  // of places in the plane by those in the cell
  glm::dvec2 place_;
};

// Part of the cell that sees a polygon.
Coverage cover(const Lens& lens, std::span<const glm::dvec3> corners) {
  Coverage coverage;
  for (std::size_t i = 0; i < corners.size(); ++i)
    coverage.add_edge(lens.place_of(corners[i]), lens.place_of(corners[(i + 1) % corners.size()]));
  return coverage;
}

// Mean radiance over the cell, before anything absorbs it, and the light sample that a shadow ray asks for.
struct Shining {
  glm::dvec3 radiance{0};
  LightSample towards{};
};

Shining see_area(const Path& path, const glm::dvec2& place, const World& world, const shared::Light& light) {
  const glm::dvec3 normal = glm::normalize(glm::dvec3(light.direction)), corner(light.position);
  const double facing = glm::dot(path.ray.direction, normal),
               along = glm::dot(corner - path.ray.origin, normal) / facing;
  if (!(along > 0) || (facing > 0 && !light.double_sided)) return {};
  const Lens lens(path, place, along, normal);
  const std::array<glm::dvec3, 3> corners = {corner, corner + glm::dvec3(light.edge1),
                                             corner + glm::dvec3(light.edge2)};
  const Coverage coverage = cover(lens, corners);
  if (!(coverage.area() > 0)) return {};
  const glm::dvec3 point = lens.seen_from(coverage.centroid()), way = point - path.ray.origin;
  Shining s{coverage.area() * glm::dvec3(light.intensity) * emitted_part(world, light.triangle, point)};
  s.towards.distance = glm::length(way);
  s.towards.direction = way / s.towards.distance;
  s.towards.triangle = light.triangle;
  return s;
}

// A light whose disc has an angular extent, if only the least one, as a regular polygon of the same area.
Shining see_disc(const Path& path, const glm::dvec2& place, const World& world, std::uint32_t index) {
  constexpr double certainly = 1;
  const shared::Light& light = world.lights[index];
  const bool sun = index < world.suns;
  Shining s;
  if (sun && light.cone_versine > shared::MOST_VERSINE) return s;
  s.towards = sample_light(world, index, certainly, path.ray.origin, glm::dvec2(0));
  if (sun) s.towards.direction = -glm::normalize(glm::dvec3(light.direction));
  const bool distant = !std::isfinite(s.towards.distance);
  const double versine = sun ? double(light.cone_versine) : double(shared::LEAST_VERSINE);
  const double sine = double(shared::DISC_CIRCUMSCRIBED) * std::sqrt(versine * (2 - versine));
  const double along = glm::dot(s.towards.direction, path.ray.direction) * (distant ? 1 : s.towards.distance);
  std::array<glm::dvec3, shared::DISC_CORNERS> corners;
  for (std::uint32_t i = 0; i < shared::DISC_CORNERS; ++i) {
    const glm::dvec3 corner = around(s.towards.direction, sine, 1 - versine, double(i) / shared::DISC_CORNERS);
    const double ahead = glm::dot(corner, path.ray.direction);
    if (ahead < double(shared::LEAST_AHEAD)) return {};
    corners[i] = distant ? corner / ahead : path.ray.origin + along / ahead * corner;
  }
  const Lens lens = distant ? Lens(path, place) : Lens(path, place, along, path.ray.direction);
  const Coverage coverage = cover(lens, corners);
  if (!(coverage.area() > 0)) return {};
  s.radiance = s.towards.irradiance * (coverage.area() / (2 * glm::pi<double>() * versine));
  if (sun) s.towards.direction = glm::normalize(lens.seen_from(coverage.centroid()));
  return s;
}

// Mean radiance of the lights that the cell sees from where the path leaves a meniscus.
glm::dvec3 shine(const Tracer& tracer, const RenderSettings& settings, const Path& path, const glm::dvec2& place) {
  const World& world = tracer.world();
  const glm::dvec3 side = glm::dot(world.triangles[path.triangle].geometric, path.ray.direction) > 0
                              ? world.triangles[path.triangle].geometric
                              : -world.triangles[path.triangle].geometric;
  glm::dvec3 sum(0);
  for (std::uint32_t i = 0; i < world.lights.size(); ++i) {
    const shared::Light& light = world.lights[i];
    Shining s;
    if (light.type == shared::LIGHT_ENVIRONMENT) continue;
    if (light.type == shared::LIGHT_AREA) {
      if (settings.highlights == shared::HIGHLIGHTS_ALL) s = see_area(path, place, world, light);
    } else {
      s = see_disc(path, place, world, i);
    }
    if (s.radiance == glm::dvec3(0) || glm::dot(s.towards.direction, side) <= 0) continue;
    const Ray shadow{path.ray.origin, s.towards.direction};
    const double reach = s.towards.distance * (s.towards.triangle == no_triangle ? 1 : 1 - 1e-9);
    if (tracer.blocked(shadow, reach, path.triangle)) continue;
    if (std::isfinite(s.towards.distance)) s.radiance *= glm::exp(-path.absorption * s.towards.distance);
    sum += s.radiance;
  }
  return path.throughput * path.radiance_scale * sum;
}

// The same from a camera ray on: through all it meets.
glm::dvec3 cell_highlight(const Tracer& tracer, const RenderSettings& settings, Path path, const glm::dvec2& place) {
  const World& world = tracer.world();
  const double through = shared::way_number(shared::WAY_THROUGH, 0),
               back = shared::way_number(shared::WAY_REFLECTED, 0);
  glm::dvec3 sum(0);
  for (std::uint32_t met = 0; met <= settings.specular_bounces;) {
    auto hit = tracer.closest(path.ray, infinity, path.triangle);
    if (!hit) break;
    absorb(path, hit->t);
    const WorldTriangle& triangle = world.triangles[hit->triangle];
    transfer(path.differential, path.ray.direction, hit->t, triangle.geometric);
    const shared::Surface surface = shade(world, *hit);
    if (pass_straight(path, *hit, tracer)) continue;
    if (!shared::shows_highlights(surface) || met++ == settings.specular_bounces) break;
    if (surface.kind == shared::SPECULAR_MIRROR)
      meets_specular(path, *hit, surface, 0, true);
    else
      path.throughput *= double(surface.specular);
    Path reflected = path;
    const double reflectance = scatter_specular(path, *hit, surface, tracer, through, glm::dvec2(0));
    if (reflectance < 1) path.throughput *= 1 - reflectance;
    if (!triangle.meniscus) continue;
    sum += shine(tracer, settings, path, place);
    if (reflectance == 0 || reflectance >= 1) continue;
    scatter_specular(reflected, *hit, surface, tracer, back, glm::dvec2(0));
    reflected.throughput *= reflectance;
    sum += shine(tracer, settings, reflected, place);
  }
  return sum;
}

}  // namespace

glm::dvec3 highlight(const Tracer& tracer, const RenderSettings& settings, const CameraAxes& axes, std::uint32_t pass,
                     std::uint32_t x, std::uint32_t y) {
  const shared::RandomKey key{settings.seed, pass, shared::STREAM_HIGHLIGHTS, y * settings.width + x};
  const std::uint32_t cells = settings.highlight_cells;
  const double side = 1.0 / cells;
  glm::dvec3 sum(0);
  for (std::uint32_t i = 0; i < cells * cells; ++i) {
    const glm::dvec2 place(shared::cell_place(key, i));
    Path path = camera_ray(settings, axes, glm::dvec2(x, y) + side * (glm::dvec2(i % cells, i / cells) + place));
    be_in(path, tracer.world(), unpack_media(settings.camera_media));
    for (std::array<glm::dvec3, 2>* d : {&path.differential.place, &path.differential.direction})
      for (glm::dvec3& v : *d) v *= side;
    sum += cell_highlight(tracer, settings, path, place);
  }
  return sum / double(cells * cells);
}

}  // namespace meniscal::reference

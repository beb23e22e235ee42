#include "host/render/demand.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <random>

#include "host/world/light_width.h"
#include "host/world/triangles.h"

namespace meniscal {
namespace {

constexpr double kLeast = 0.25, kMost = 16, kMostHidden = 4;
constexpr double kCausticPixels = 0.25, kSeenPixels = 0.1;
// Of the turn of the surface's normal, that of the light it refracts: (n - 1) / n is a quarter for water, more where
// light comes in aslant.
constexpr double kDeflected = 0.5;
constexpr double kSteep = 0.5;  // cosine to the vertical of the flattest way of refracted light that counts

// Triangles alone, of what light does not go through.
World opaque_part(const Scene& scene) {
  World world;
  for (const Object& o : scene.objects) {
    const Material& m = scene.materials[static_cast<std::size_t>(o.material)];
    if (m.liquid || m.transmission > 0) continue;
    append(world.triangles, o.mesh, {.material = static_cast<std::uint32_t>(o.material)});
  }
  world.radius = radius_of(world.triangles);
  return world;
}

// At most so many of them, evenly.
template <class Visit>
void for_some(std::span<const glm::dvec3> points, std::size_t most, const Visit& visit) {
  const std::size_t count = std::min(points.size(), most);
  for (std::size_t i = 0; i < count; ++i) visit(points[i * points.size() / count]);
}

}  // namespace

Demand::Demand(const Scene& scene, const RenderSettings& settings)
    : scene_(scene),
      axes_(camera_axes(settings.camera, settings.width, settings.height)),
      orthographic_(settings.camera.orthographic),
      per_pixel_(pixel_side(axes_, settings.height)),
      hidden_(std::min(narrowest_light(scene) / kHidingLight, kMostHidden)),
      opaque_(opaque_part(scene)),
      tracer_(opaque_) {
  for (const Material& m : scene.materials) {
    emits_.push_back(m.emission != glm::dvec3(0));
    mirrors_ = mirrors_ || (m.metallic > 0.5 && m.roughness < 0.3);
  }
  view_ = look();
  for (const WorldTriangle& t : opaque_.triangles)
    if (emits_[t.material]) lamps_.push_back((t.corner[0] + t.corner[1] + t.corner[2]) / 3.0);
}

std::vector<glm::dvec3> Demand::look() const {
  constexpr int columns = 16, rows = 12;
  std::vector<glm::dvec3> points;
  for (int i = 0; i < columns * rows; ++i) {
    const glm::dvec3 offset =
        ((i % columns + 0.5) / columns * 2 - 1) * axes_.right + ((i / columns + 0.5) / rows * 2 - 1) * axes_.up;
    const glm::dvec3 from = orthographic_ ? axes_.origin + offset : axes_.origin;
    const glm::dvec3 way = glm::normalize(orthographic_ ? axes_.forward : axes_.forward + offset);
    if (const auto hit = tracer_.closest({from, way}, INFINITY, reference::no_triangle))
      points.push_back(hit->point - 1e-6 * opaque_.radius * way);  // on this side of it
  }
  return points;
}

double Demand::footprint(const glm::dvec3& point) const {
  return orthographic_ ? per_pixel_ : per_pixel_ * glm::distance(point, axes_.origin);
}

bool Demand::in_frame(const glm::dvec3& point) const {
  constexpr double margin = 1.1;
  const glm::dvec3 way = point - axes_.origin;
  const double depth = orthographic_ ? 1 : glm::dot(way, axes_.forward);
  const auto within = [&](const glm::dvec3& axis) {
    return std::abs(glm::dot(way, axis)) <= margin * depth * glm::dot(axis, axis);
  };
  return within(axes_.right) && within(axes_.up);
}

bool Demand::is_free(const glm::dvec3& from, const glm::dvec3& to) const {
  const glm::dvec3 way = to - from;
  return !tracer_.blocked({from, glm::normalize(way)}, glm::length(way) * (1 - 1e-9), reference::no_triangle);
}

double Demand::coarsest(const glm::dvec3& point, double capillary_length) const {
  const double normal = glm::radians(meniscus::kNormalTolerance);
  const auto for_caustic_at = [&](const glm::dvec3& there) {
    return kCausticPixels * footprint(there) / (kDeflected * normal * glm::distance(point, there));
  };
  double coarseness = kMost;
  // Where light changes shifts as the normal turns, by about a capillary length a radian.
  if (mirrors_ || in_frame(point))
    coarseness = std::min(kSeenPixels * footprint(point) / (normal * capillary_length), std::max(hidden_, 1.0));
  // Refracted light goes steeply down, or up: by steps over what it may light, and by steps over what is seen.
  for (const double side : {-1.0, 1.0})
    for (int i = -1; i < 4; ++i) {
      const double slant = i < 0 ? 0 : 0.6, turn = i * glm::half_pi<double>();
      const glm::dvec3 way(slant * std::cos(turn), side * std::sqrt(1 - slant * slant), slant * std::sin(turn));
      const auto hit = tracer_.closest({point, way}, INFINITY, reference::no_triangle);
      // What falls elsewhere is seen as it lights its surroundings, if at all.
      if (hit && (mirrors_ || in_frame(hit->point)))
        coarseness = std::min(coarseness, std::max(for_caustic_at(hit->point), hidden_));
    }
  for (const glm::dvec3& seen : view_) {
    const bool steep = std::abs(seen.y - point.y) > kSteep * glm::distance(seen, point);
    const double here = std::max(for_caustic_at(seen), hidden_);
    if (steep && here < coarseness && is_free(point, seen)) coarseness = here;
  }
  return coarseness;
}

bool Demand::reaches_camera(const glm::dvec3& point) const {
  if (!in_frame(point)) return false;
  const glm::dvec3 to_eye = axes_.origin - point;
  const glm::dvec3 way = orthographic_ ? glm::dot(to_eye, axes_.forward) * axes_.forward : to_eye;
  return glm::dot(way, axes_.forward) < 0 && is_free(point, point + way);
}

// `choice`: in [0, 1), of the lights.
bool Demand::meets_light(const glm::dvec3& point, double choice) const {
  const std::size_t lights = scene_.lights.size(), all = lights + lamps_.size();
  if (all == 0) return false;
  const auto chosen = static_cast<std::size_t>(choice * double(all));
  if (chosen >= lights) return is_free(point, lamps_[chosen - lights]);
  const PunctualLight& l = scene_.lights[chosen];
  if (l.type != PunctualLight::Type::directional) return is_free(point, l.position);
  return !tracer_.blocked({point, -l.direction}, INFINITY, reference::no_triangle);
}

// Walks at random from the contact line, until one of them has met a light and one the camera or what it sees.
bool Demand::matters(std::span<const glm::dvec3> beside) const {
  constexpr int rounds = 8, steps = 12;
  std::mt19937 bits(1);
  const auto unit = [&] { return double(bits()) * 0x1p-32; };
  bool lit = false, seen = false;
  for_some(beside, 8, [&](const glm::dvec3& at) {
    seen = seen || std::any_of(view_.begin(), view_.end(), [&](const glm::dvec3& there) { return is_free(at, there); });
  });
  for (int round = 0; round < rounds; ++round)
    for_some(beside, 8, [&](glm::dvec3 at) {
      for (int step = 0; step < steps && !(lit && seen); ++step) {
        lit = lit || meets_light(at, unit());
        seen = seen || reaches_camera(at);
        const double z = 2 * unit() - 1, turn = glm::two_pi<double>() * unit(), r = std::sqrt(1 - z * z);
        const glm::dvec3 way(r * std::cos(turn), z, r * std::sin(turn));
        const auto hit = tracer_.closest({at, way}, INFINITY, reference::no_triangle);
        if (!hit) {
          lit = lit || scene_.environment;
          break;
        }
        const WorldTriangle& triangle = opaque_.triangles[hit->triangle];
        lit = lit || emits_[triangle.material];
        const glm::dvec3 side = glm::dot(way, triangle.geometric) > 0 ? -triangle.geometric : triangle.geometric;
        at = hit->point + 1e-9 * opaque_.radius * side;
      }
    });
  return lit && seen;
}

meniscus::Need Demand::need(std::span<const glm::dvec3> beside, double capillary_length) const {
  if (beside.empty()) return {};
  if (!matters(beside)) return {kMost, false};
  double coarseness = kMost;
  for_some(beside, 16,
           [&](const glm::dvec3& point) { coarseness = std::min(coarseness, coarsest(point, capillary_length)); });
  return {std::max(coarseness, kLeast), true};
}

}  // namespace meniscal

#include "host/render/demand.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <random>

#include "host/world/light_width.h"

namespace meniscal {
namespace {

constexpr double kLeast = 0.25, kMost = 16, kMostHidden = 4;
constexpr double kCausticPixels = 0.25, kSeenPixels = 0.1;
// Of the turn of the surface's normal, that of the light it refracts: (n - 1) / n is a quarter for water, more where
// light comes in aslant.
constexpr double kDeflected = 0.5;

// Triangles alone, of what light does not go through.
World opaque_part(const Scene& scene) {
  World world;
  for (const Object& o : scene.objects) {
    const Material& m = scene.materials[static_cast<std::size_t>(o.material)];
    if (m.liquid || m.transmission > 0) continue;
    for (const glm::uvec3& t : o.mesh.triangles) {
      WorldTriangle triangle{};
      for (int k = 0; k < 3; ++k) {
        triangle.corner[k] = o.mesh.positions[t[k]], triangle.normal[k] = o.mesh.normals[t[k]];
        world.radius = std::max(world.radius, glm::length(triangle.corner[k]));
      }
      const glm::dvec3 facing =
          glm::cross(triangle.corner[1] - triangle.corner[0], triangle.corner[2] - triangle.corner[0]);
      if (!(glm::length(facing) > 0)) continue;
      triangle.geometric = glm::normalize(facing);
      triangle.material = static_cast<std::uint32_t>(o.material);
      world.triangles.push_back(triangle);
    }
  }
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
      per_pixel_(2 * glm::length(axes_.up) / settings.height),
      hidden_(std::min(narrowest_light(scene) / kHidingLight, kMostHidden)),
      opaque_(opaque_part(scene)),
      tracer_(opaque_) {
  for (const Material& m : scene.materials) {
    emits_.push_back(m.emission != glm::dvec3(0));
    mirrors_ = mirrors_ || (m.metallic > 0.5 && m.roughness < 0.3);
  }
  for (const WorldTriangle& t : opaque_.triangles)
    if (emits_[t.material]) lamps_.push_back((t.corner[0] + t.corner[1] + t.corner[2]) / 3.0);
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

double Demand::coarsest(const glm::dvec3& point, double capillary_length) const {
  const double normal = glm::radians(meniscus::kNormalTolerance);
  double coarseness = kMost;
  // Where light changes shifts as the normal turns, by about a capillary length a radian.
  if (mirrors_ || in_frame(point))
    coarseness = std::min(kSeenPixels * footprint(point) / (normal * capillary_length), std::max(hidden_, 1.0));
  // Refracted light goes steeply down, or up.
  for (const double side : {-1.0, 1.0})
    for (int i = -1; i < 4; ++i) {
      const double slant = i < 0 ? 0 : 0.6, turn = i * glm::half_pi<double>();
      const glm::dvec3 way(slant * std::cos(turn), side * std::sqrt(1 - slant * slant), slant * std::sin(turn));
      const auto hit = tracer_.closest({point, way}, INFINITY, reference::no_triangle);
      // What falls elsewhere is seen as it lights its surroundings, if at all.
      if (!hit || !(mirrors_ || in_frame(hit->point))) continue;
      const double of_pixel = kCausticPixels * footprint(hit->point) / (kDeflected * normal * hit->t);
      coarseness = std::min(coarseness, std::max(of_pixel, hidden_));
    }
  return coarseness;
}

bool Demand::reaches_camera(const glm::dvec3& point) const {
  if (!in_frame(point)) return false;
  const glm::dvec3 to_eye = axes_.origin - point;
  const glm::dvec3 way = orthographic_ ? glm::dot(to_eye, axes_.forward) * axes_.forward : to_eye;
  return glm::dot(way, axes_.forward) < 0 &&
         !tracer_.blocked({point, glm::normalize(way)}, glm::length(way) * (1 - 1e-9), reference::no_triangle);
}

// `choice`: in [0, 1), of the lights.
bool Demand::meets_light(const glm::dvec3& point, double choice) const {
  const double reach = 1 - 1e-6;
  for (const PunctualLight& l : scene_.lights) {
    const bool distant = l.type == PunctualLight::Type::directional;
    const glm::dvec3 way = distant ? -l.direction : l.position - point;
    const double length = distant ? double(INFINITY) : glm::length(way) * reach;
    if (!tracer_.blocked({point, glm::normalize(way)}, length, reference::no_triangle)) return true;
  }
  if (lamps_.empty()) return false;
  const glm::dvec3 way = lamps_[static_cast<std::size_t>(choice * double(lamps_.size()))] - point;
  return !tracer_.blocked({point, glm::normalize(way)}, glm::length(way) * reach, reference::no_triangle);
}

// Walks at random from the contact line, until one of them has met a light and one the camera.
bool Demand::matters(std::span<const glm::dvec3> beside) const {
  constexpr int rounds = 8, steps = 12;
  std::mt19937 bits(1);
  const auto unit = [&] { return double(bits()) * 0x1p-32; };
  bool lit = false, seen = false;
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

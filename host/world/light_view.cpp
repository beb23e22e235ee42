#include "host/world/light_view.h"

#include <cmath>
#include <limits>

namespace meniscal {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// 1 degree across: in views of wider suns photons make larger errors than if they start on targets (measured: at 5
// degrees 9.0 % against 5.7 %, at half a degree 5.6 % against 6.7 %).
constexpr double widest_versine = 3.9e-5;

// Bounds of the corners of targets first .. first + count along two axes.
glm::dvec4 bounds(const World& world, std::uint32_t first, std::size_t count, const glm::dvec3& u,
                  const glm::dvec3& v) {
  glm::dvec4 box(infinity, infinity, -infinity, -infinity);
  for (std::size_t i = first; i < first + count; ++i)
    for (const glm::dvec3& c : world.triangles[world.targets[i]].corner) {
      const glm::dvec2 p(glm::dot(c, u), glm::dot(c, v));
      box = {glm::min(glm::dvec2(box), p), glm::max(glm::dvec2(box.z, box.w), p)};
    }
  return box;
}

}  // namespace

std::optional<LightView> find_light_view(const World& world, const shared::Light& light) {
  if (light.type != shared::LIGHT_DIRECTIONAL || double(light.cone_versine) > widest_versine || world.targets.empty())
    return std::nullopt;
  const glm::dvec3 along = glm::normalize(glm::dvec3(light.direction));
  const glm::dvec3 u =
      glm::normalize(std::abs(along.x) > 0.6 ? glm::dvec3(along.z, 0, -along.x) : glm::dvec3(0, -along.z, along.y));
  const glm::dvec3 v = glm::cross(along, u);
  double seen = 0;  // area of the targets in projection
  for (std::uint32_t i : world.targets)
    seen += world.triangles[i].area * std::abs(glm::dot(world.triangles[i].geometric, along));
  // The view lies in the middle of the targets, where slanted light goes least far from where it meets them. A margin
  // for that, and of float's rounding at the scene's size, so that no edge is lost.
  const glm::dvec4 depths = bounds(world, 0, world.targets.size(), along, along);
  const double middle = 0.5 * (depths.x + depths.z), versine = double(light.cone_versine);
  const double slant = std::sqrt(versine * (2 - versine)) / (1 - versine);
  const double margin = 1e-6 * world.radius + 0.5 * (depths.z - depths.x) * slant;
  const glm::dvec4 box = bounds(world, 0, world.targets.size(), u, v) + margin * glm::dvec4(-1, -1, 1, 1);
  const glm::dvec2 size(box.z - box.x, box.w - box.y);
  if (seen < 0.25 * size.x * size.y) return std::nullopt;
  return LightView{box.x * u + box.y * v + middle * along, size.x * u, size.y * v, size.x * size.y};
}

glm::dvec4 bounds_in(const LightView& view, const World& world, const Stratum& stratum) {
  const glm::dvec3 u = view.u / glm::dot(view.u, view.u), v = view.v / glm::dot(view.v, view.v);
  const glm::dvec2 corner(glm::dot(view.corner, u), glm::dot(view.corner, v));
  return bounds(world, stratum.first, stratum.count, u, v) - glm::dvec4(corner, corner);
}

}  // namespace meniscal

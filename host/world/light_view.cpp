#include "host/world/light_view.h"

#include <cmath>
#include <limits>

namespace meniscal {

std::optional<LightView> find_light_view(const World& world, const Stratum& stratum) {
  if (world.lights.size() != 1 || world.lights[0].type != shared::LIGHT_DIRECTIONAL) return std::nullopt;
  const glm::dvec3 along = glm::normalize(glm::dvec3(world.lights[0].direction));
  const glm::dvec3 u =
      glm::normalize(std::abs(along.x) > 0.6 ? glm::dvec3(along.z, 0, -along.x) : glm::dvec3(0, -along.z, along.y));
  const glm::dvec3 v = glm::cross(along, u);
  glm::dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
  double seen = 0;  // area of the targets in projection
  for (std::uint32_t i = stratum.first; i < stratum.first + stratum.count; ++i) {
    const WorldTriangle& t = world.triangles[world.targets[i]];
    seen += t.area * std::abs(glm::dot(t.geometric, along));
    for (const glm::dvec3& c : t.corner) {
      const glm::dvec2 p(glm::dot(c, u), glm::dot(c, v));
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  }
  // A margin of float's rounding at the scene's size, so that no edge is lost.
  const double margin = 1e-6 * world.radius;
  low -= margin, high += margin;
  const glm::dvec2 size = high - low;
  if (seen < 0.25 * size.x * size.y) return std::nullopt;
  return LightView{low.x * u + low.y * v - 1.01 * world.radius * along, size.x * u, size.y * v, size.x * size.y};
}

}  // namespace meniscal

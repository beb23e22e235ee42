#include "host/render/stand_clear.h"

#include <cmath>
#include <optional>

#include "host/world/triangles.h"

namespace meniscal {

namespace {

// Off the nearest of the surfaces that `point` lies on; nothing, if it lies on none.
std::optional<glm::dvec3> step_off(const World& world, const glm::dvec3& point) {
  const double room = 2e-6 * world.radius;
  double least = 0.5 * room;
  std::optional<glm::dvec3> clear;
  for (const WorldTriangle& t : world.triangles) {
    const double height = glm::dot(point - t.corner[0], t.geometric);
    if (std::abs(height) >= least || !is_over(t, point)) continue;
    least = std::abs(height);
    clear = point + ((height < 0 ? -room : room) - height) * t.geometric;
  }
  return clear;
}

}  // namespace

glm::dvec3 stand_clear(const World& world, const glm::dvec3& point) {
  constexpr int most = 3;  // surfaces that meet in a corner
  glm::dvec3 clear = point;
  for (int i = 0; i < most; ++i) {
    const auto next = step_off(world, clear);
    if (!next) break;
    clear = *next;
  }
  return clear;
}

}  // namespace meniscal

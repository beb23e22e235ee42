#include "host/render/stand_clear.h"

#include <algorithm>
#include <cmath>

namespace meniscal {
namespace {

bool is_above_or_below(const WorldTriangle& t, const glm::dvec3& point) {
  double least = 0, most = 0;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 from = t.corner[i], to = t.corner[(i + 1) % 3];
    const double side = glm::dot(glm::cross(to - from, point - from), t.geometric);
    least = std::min(least, side), most = std::max(most, side);
  }
  return least == 0 || most == 0;
}

}  // namespace

glm::dvec3 stand_clear(const World& world, const glm::dvec3& point) {
  const double room = 2e-6 * world.radius;
  double least = 0.5 * room;
  glm::dvec3 clear = point;
  for (const WorldTriangle& t : world.triangles) {
    const double height = glm::dot(point - t.corner[0], t.geometric);
    if (std::abs(height) >= least || !is_above_or_below(t, point)) continue;
    least = std::abs(height);
    clear = point + ((height < 0 ? -room : room) - height) * t.geometric;
  }
  return clear;
}

}  // namespace meniscal

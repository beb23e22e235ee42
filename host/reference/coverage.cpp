#include "host/reference/coverage.h"

#include <algorithm>

namespace meniscal::reference {

void Coverage::add_edge(glm::dvec2 a, glm::dvec2 b) {
  if (a.x == b.x) return;
  // Beyond the left and the right side nothing lies below the edge; beyond the bottom and the top it runs along them.
  const glm::dvec2 along = b - a;
  const auto at = [&](double value, int axis) { return (value - a[axis]) / along[axis]; };
  const double left = at(0, 0), right = at(1, 0);
  const double first = std::clamp(std::min(left, right), 0.0, 1.0), last = std::clamp(std::max(left, right), 0.0, 1.0);
  double bottom = last, top = last;
  if (along.y != 0) bottom = std::clamp(at(0, 1), first, last), top = std::clamp(at(1, 1), first, last);
  const double bends[] = {first, std::min(bottom, top), std::max(bottom, top), last};
  for (int i = 0; i < 3; ++i) {
    const glm::dvec2 p = glm::clamp(a + bends[i] * along, 0.0, 1.0), q = glm::clamp(a + bends[i + 1] * along, 0.0, 1.0);
    const double width = q.x - p.x;
    area_ += width * (p.y + q.y) / 2;
    moment_.x += width * (p.x * (2 * p.y + q.y) + q.x * (p.y + 2 * q.y)) / 6;
    moment_.y += width * (p.y * p.y + p.y * q.y + q.y * q.y) / 6;
  }
}

}  // namespace meniscal::reference

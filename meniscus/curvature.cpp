#include "meniscus/curvature.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "meniscus/field.h"
#include "meniscus/predicates.h"

namespace meniscus {
namespace {

// The integral of the direction's turn along a line: its second difference over w is the mean that is wanted, since
// the second derivative is the curvature. Continuous across corners.
class TurnIntegral {
 public:
  explicit TurnIntegral(const ContactLine& line) : closed_(line.closed) {
    double along = 0, turn = 0, integral = 0;
    for (std::size_t i = 0; i < line.segments(); ++i) {
      const Node &node = line.nodes[i], &next = line.next(i);
      if (i > 0) turn -= turn_between(node.before.direction, node.after.direction);
      const double bend = -turn_between(node.after.direction, next.before.direction);
      const double chord = glm::distance(planar(node.position), planar(next.position));
      const double arc = bend == 0 ? chord : chord * (bend / 2) / std::sin(bend / 2);
      knots_.push_back({along, turn, integral});
      along += arc, integral += arc * (turn + bend / 2), turn += bend;
    }
    if (closed_) turn -= turn_between(line.nodes[0].before.direction, line.nodes[0].after.direction);
    knots_.push_back({along, turn, integral});
  }

  double length() const { return knots_.back().along; }
  double along(std::size_t node) const { return knots_[node].along; }

  double at(double along) const {
    const auto& [length, turn, integral] = knots_.back();
    if (closed_) {  // every time round adds the whole turn
      const double rounds = std::floor(along / length), rest = along - rounds * length;
      return within(rest) + rounds * integral + turn * (rounds * rest + 0.5 * length * rounds * (rounds - 1));
    }
    if (along < 0) return within(-along);
    return along <= length ? within(along) : within(2 * length - along) + 2 * turn * (along - length);
  }

 private:
  struct Knot {
    double along, turn, integral;  // at a node; the turn is that behind its corner
  };

  double within(double along) const {
    const auto after = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, along,
                                        [](double a, const Knot& knot) { return a < knot.along; });
    const Knot &a = after[-1], &b = *after;
    const double arc = b.along - a.along, x = along - a.along;
    if (!(arc > 0)) return a.integral;
    const double bend = 2 * ((b.integral - a.integral) / arc - a.turn);
    return a.integral + x * (a.turn + 0.5 * bend * x / arc);
  }

  bool closed_;
  std::vector<Knot> knots_;
};

}  // namespace

void measure_curvature(ContactLine& line, double within) {
  const TurnIntegral integral(line);
  if (!(integral.length() > 0)) return;
  const double w = line.closed ? within : std::min(within, integral.length());
  for (std::size_t i = 0; i < line.nodes.size(); ++i) {
    const double at = integral.along(i);
    line.nodes[i].curvature = (integral.at(at + w) - 2 * integral.at(at) + integral.at(at - w)) / (w * w);
  }
}

}  // namespace meniscus

#include "meniscus/field.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "meniscus/predicates.h"

namespace meniscus {
namespace {

glm::dvec3 flat(const glm::dvec2& p) { return {p.x, p.y, 0}; }

// Parameters t at which x - (a + t e) is parallel to m + t f: the real roots of cross(q - t e, m + t f) = 0, q = x - a.
struct Roots {
  std::array<double, 2> t;
  int count;
};
Roots parallel(const glm::dvec2& q, const glm::dvec2& e, const glm::dvec2& m, const glm::dvec2& f) {
  const double a = -cross(e, f), b = cross(q, f) - cross(e, m), c = cross(q, m);
  if (a == 0) return b == 0 ? Roots{{}, 0} : Roots{{-c / b, 0}, 1};
  const double discriminant = b * b - 4 * a * c;
  if (discriminant < 0) return {{}, 0};
  const double s = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  return s == 0 ? Roots{{0, 0}, 1} : Roots{{c / s, s / a}, 2};
}

}  // namespace

double turn_between(const glm::dvec2& from, const glm::dvec2& to) {
  return std::atan2(cross(from, to), glm::dot(from, to));
}

Field::Field(const std::vector<ContactLine>& lines) : lines_(lines), tree_({}) {
  std::vector<Box> boxes;
  const auto add = [&](const Element& element, const glm::dvec3& a, const glm::dvec3& b) {
    Box box;
    box.add(flat(planar(a)));
    box.add(flat(planar(b)));
    elements_.push_back(element);
    boxes.push_back(box);
  };
  for (std::size_t l = 0; l < lines.size(); ++l) {
    const ContactLine& line = lines[l];
    for (std::size_t i = 0; i < line.nodes.size(); ++i) {
      const Node& node = line.nodes[i];
      const bool end = !line.closed && (i == 0 || i + 1 == line.nodes.size());
      if (i < line.segments()) add({Kind::segment, l, i}, node.position, line.next(i).position);
      if (end) add({Kind::end, l, i}, node.position, node.position);
      if (node.joint && turn_between(node.before.direction, node.after.direction) < 0) {
        add({Kind::fan, l, i}, node.position, node.position);
      }
    }
  }
  tree_ = Tree(std::move(boxes));
}

Foot Field::foot_on(const Element& element, const glm::dvec2& x) const {
  constexpr double kOver = 1e-9;  // so that no point falls between two neighbours
  const ContactLine& line = lines_[element.line];
  const Node& node = line.nodes[element.node];
  const glm::dvec2 q = x - planar(node.position);
  Foot foot;
  foot.line = element.line, foot.node = element.node;
  if (element.kind == Kind::segment) {
    const Node& next = line.next(element.node);
    const glm::dvec2 e = planar(next.position) - planar(node.position);
    const glm::dvec2 m = node.after.direction, f = next.before.direction - m;
    const Roots roots = parallel(q, e, m, f);
    for (int k = 0; k < roots.count; ++k) {
      if (!(roots.t[k] >= -kOver && roots.t[k] <= 1 + kOver)) continue;
      const double t = std::clamp(roots.t[k], 0.0, 1.0);
      const glm::dvec2 direction = glm::normalize(m + t * f);
      const double distance = glm::dot(q - t * e, direction);
      if (distance < -kOver * glm::length(e) || distance >= foot.distance) continue;
      foot.from = &node.after, foot.to = &next.before;
      foot.t = t, foot.direction = direction, foot.distance = std::max(distance, 0.0);
    }
    return foot;
  }
  const double distance = glm::length(q);
  if (distance == 0) return foot;  // the segments that meet here have it
  const glm::dvec2 direction = q / distance;
  if (element.kind == Kind::fan) {
    const double whole = turn_between(node.before.direction, node.after.direction);
    const double part = turn_between(node.before.direction, direction) / whole;
    if (!(part >= -kOver && part <= 1 + kOver)) return foot;
    foot.from = &node.before, foot.to = &node.after;
    foot.t = std::clamp(part, 0.0, 1.0), foot.fan = -whole;
  } else {
    const glm::dvec2 left = node.contact.direction, forward{left.y, -left.x};
    const bool beyond = (element.node == 0 ? -1 : 1) * glm::dot(direction, forward) >= 0;
    if (!beyond) return foot;
    foot.from = foot.to = &node.contact;
  }
  foot.direction = direction, foot.distance = distance;
  return foot;
}

Foot Field::any_foot(const glm::dvec2& x, double limit) const {
  Foot any;
  tree_.nearest(flat(x), limit, [&](std::uint32_t i) {
    const Foot foot = foot_on(elements_[i], x);
    if (foot.exists() && foot.distance <= limit) any = foot;
    return any.exists() ? -1 : limit;
  });
  return any;
}

double Field::free_length(const glm::dvec2& from, const glm::dvec2& direction, double limit, int tries) const {
  constexpr double kNearer = 1 - 1e-6, kPrecise = 1 - 1e-4;
  for (int k = 1; k <= tries; ++k) {
    double free = limit * k / tries;
    const double least = limit * (k - 1) / tries;
    bool own = true;
    for (;;) {  // the circle through `from` shrinks until no other foot lies in it
      const glm::dvec2 x = from + free * direction;
      const Foot foot = any_foot(x, kNearer * free);
      if (!foot.exists()) break;
      own = false;
      const glm::dvec2 to = x - foot.distance * foot.direction - from;
      const double smaller = 0.5 * glm::dot(to, to) / glm::dot(to, direction);
      if (!(smaller > least)) return least;
      if (smaller > kPrecise * free) return std::min(smaller, free);
      free = smaller;
    }
    if (!own) return free;
  }
  return limit;
}

Foot Field::foot(const glm::dvec2& x, double limit) const {
  Foot best;
  best.distance = limit;
  tree_.nearest(flat(x), limit, [&](std::uint32_t i) {
    const Foot foot = foot_on(elements_[i], x);
    if (foot.exists() && foot.distance <= best.distance) {
      const bool tie = best.exists() && foot.distance == best.distance;
      if (!tie || foot.line < best.line) best = foot;
    }
    return best.distance;
  });
  return best;
}

}  // namespace meniscus

// The constraints of a triangulation; see triangulate.h.
#include <algorithm>
#include <cmath>
#include <deque>
#include <stdexcept>

#include "meniscus/predicates.h"
#include "meniscus/triangulate.h"

namespace meniscus {
namespace {

// Where segment ab crosses cd, on ab. What is parallel within rounding meets at an end of one that the other holds.
glm::dvec2 meeting(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d) {
  const double across = cross(b - a, d - c);
  if (across != 0) return a + glm::clamp(cross(c - a, d - c) / across, 0.0, 1.0) * (b - a);
  for (const glm::dvec2& end : {c, d})
    if (const double along = glm::dot(end - a, b - a); along > 0 && along < glm::dot(b - a, b - a)) return end;
  return a;
}

}  // namespace

// The vertex where segment ab crosses the constraint cd, which it parts: one of the four, or of the triangle there,
// where they meet within rounding, or a new one. Else constraints that nearly coincide would cross anew, ever more
// finely, beside each vertex that rounding has moved off them.
std::uint32_t Triangulation::cut(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  constexpr double kRounding = 1e-11;
  const glm::dvec2 x = meeting(points_[a], points_[b], points_[c], points_[d]);
  const double near = kRounding * std::max(std::abs(x.x), std::abs(x.y));
  const auto is_near = [&](std::uint32_t v) { return glm::distance(points_[v], x) <= near; };
  if (is_near(c)) return c;
  if (is_near(d)) return d;
  const Crossing crossing = constraints_.at(key(c, d));
  const int sense = c < d ? 1 : -1;
  constraints_.erase(key(c, d));  // x is only nearly on cd: the two halves are put back as edges of their own
  const auto& there = triangles_[locate(x)].v;
  const auto known = std::find_if(there.begin(), there.end(), is_near);
  const std::uint32_t m = is_near(a) ? a : is_near(b) ? b : known != there.end() ? *known : insert(x);
  constrain(c, m, {sense * crossing.solid, sense * crossing.patch});
  constrain(m, d, {sense * crossing.solid, sense * crossing.patch});
  return m;
}

void Triangulation::constrain(std::uint32_t a, std::uint32_t b, Crossing left_to_right) {
  if (a == b) return;
  const auto through = [&](std::uint32_t m) {
    constrain(a, m, left_to_right);
    constrain(m, b, left_to_right);
  };
  if (find_edge(a, b).first != kNone || find_edge(b, a).first != kNone) {
    Crossing& crossing = constraint_of(a, b);
    const int sense = a < b ? 1 : -1;
    crossing.solid += sense * left_to_right.solid, crossing.patch += sense * left_to_right.patch;
    return;
  }
  // The triangle at a through whose far side (right, left) the segment leaves.
  std::uint32_t t = triangle_of_[a], right = kNone, left = kNone;
  for (const std::uint32_t start = t;;) {
    const int i = corner(t, a);
    const std::uint32_t r = triangles_[t].v[(i + 1) % 3], l = triangles_[t].v[(i + 2) % 3];
    const int to_r = turn(a, b, r), to_l = turn(a, b, l);
    if (to_r == 0 && glm::dot(points_[r] - points_[a], points_[b] - points_[a]) > 0) return through(r);
    if (to_r < 0 && to_l > 0) {
      right = r, left = l;
      break;
    }
    t = triangles_[t].n[(i + 1) % 3];
    if (t == kNone || t == start) throw std::logic_error("a constraint leaves the triangulation");
  }
  std::vector<Key> crossed;
  for (;;) {
    if (fixed(right, left)) {
      const std::uint32_t m = cut(a, b, right, left);
      return through(m);
    }
    crossed.push_back(key(right, left));
    const auto [beyond, i] = find_edge(left, right);
    t = beyond;
    const std::uint32_t apex = triangles_[t].v[i];
    if (apex == b) break;
    const int side = turn(a, b, apex);
    if (side == 0) return through(apex);
    (side > 0 ? left : right) = apex;
  }
  flip_until_edge(a, b, std::move(crossed));
  constrain(a, b, left_to_right);
}

// Flips the edges that cross ab until none does, then restores the Delaunay property beside it (Sloan 1993).
void Triangulation::flip_until_edge(std::uint32_t a, std::uint32_t b, std::vector<Key> crossed) {
  std::deque<Key> queue(crossed.begin(), crossed.end());
  std::vector<Key> made;
  while (!queue.empty()) {
    const auto [c, d] = queue.front();
    queue.pop_front();
    const auto [t, i] = find_edge(c, d);
    const std::uint32_t p = triangles_[t].v[i], u = triangles_[t].n[i], q = triangles_[u].v[side_to(u, t)];
    if (turn(p, c, q) <= 0 || turn(q, d, p) <= 0) {  // not convex: its turn comes later
      queue.emplace_back(c, d);
      continue;
    }
    flip(t, i);
    const bool crosses = p != a && p != b && q != a && q != b && turn(a, b, p) * turn(a, b, q) < 0;
    if (crosses) {
      queue.push_back(key(p, q));
    } else {
      made.push_back(key(p, q));
    }
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (Key& e : made) {
      if (e == key(a, b) || fixed(e.first, e.second)) continue;
      const auto [t, i] = find_edge(e.first, e.second);
      const std::uint32_t u = triangles_[t].n[i], p = triangles_[t].v[i], q = triangles_[u].v[side_to(u, t)];
      if (!in_circle(triangles_[t], q)) continue;
      flip(t, i);
      e = key(p, q);
      changed = true;
    }
  }
}

const Crossing* Triangulation::constraint(std::uint32_t t, int i, int& sense) const {
  const std::uint32_t a = triangles_[t].v[(i + 1) % 3], b = triangles_[t].v[(i + 2) % 3];
  if (!ends_constraint_[a] || !ends_constraint_[b]) return nullptr;
  const auto found = constraints_.find(key(a, b));
  if (found == constraints_.end()) return nullptr;
  sense = a < b ? 1 : -1;
  return &found->second;
}

}  // namespace meniscus

#include "meniscus/triangulate.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "meniscus/predicates.h"

namespace meniscus {

Triangulation::Triangulation(const glm::dvec2& low, const glm::dvec2& high) {
  const glm::dvec2 centre = 0.5 * (low + high);
  const double size = 64 * std::max({high.x - low.x, high.y - low.y, 1e-300});
  points_ = {centre + glm::dvec2(-size, -size), centre + glm::dvec2(size, -size), centre + glm::dvec2(0, size)};
  triangle_of_ = {0, 0, 0};
  ends_constraint_.assign(3, false);
  triangles_.push_back({{0, 1, 2}, {kNone, kNone, kNone}});
}

int Triangulation::turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  return orient2d(points_[a], points_[b], points_[c]);
}

// Certainly within the circle; ties and doubtful cases count as outside, so that flipping always ends.
bool Triangulation::in_circle(const Triangle& t, std::uint32_t d) const {
  const glm::dvec2 a = points_[t.v[0]] - points_[d], b = points_[t.v[1]] - points_[d], c = points_[t.v[2]] - points_[d];
  const double aa = glm::dot(a, a), bb = glm::dot(b, b), cc = glm::dot(c, c);
  const double det = aa * cross(b, c) + bb * cross(c, a) + cc * cross(a, b);
  const double size = aa * (std::abs(b.x * c.y) + std::abs(b.y * c.x)) +
                      bb * (std::abs(c.x * a.y) + std::abs(c.y * a.x)) +
                      cc * (std::abs(a.x * b.y) + std::abs(a.y * b.x));
  return det > 2e-15 * size;
}

int Triangulation::corner(std::uint32_t t, std::uint32_t vertex) const {
  const auto& v = triangles_[t].v;
  return v[0] == vertex ? 0 : v[1] == vertex ? 1 : 2;
}

int Triangulation::side_to(std::uint32_t t, std::uint32_t neighbour) const {
  const auto& n = triangles_[t].n;
  return n[0] == neighbour ? 0 : n[1] == neighbour ? 1 : 2;
}

void Triangulation::replace_neighbour(std::uint32_t t, std::uint32_t from, std::uint32_t to) {
  if (t != kNone) triangles_[t].n[side_to(t, from)] = to;
}

void Triangulation::set(std::uint32_t t, std::array<std::uint32_t, 3> v, std::array<std::uint32_t, 3> n) {
  if (t == triangles_.size()) triangles_.emplace_back();
  triangles_[t] = {v, n};
  for (const std::uint32_t vertex : v) triangle_of_[vertex] = t;
}

// Walks towards p. Where constraints have bent the way into a circle, looks at every triangle.
std::uint32_t Triangulation::locate(const glm::dvec2& p) const {
  std::uint32_t t = last_;
  for (std::size_t step = 0; step < triangles_.size() + 3; ++step) {
    const Triangle& triangle = triangles_[t];
    std::uint32_t next = kNone;
    for (int k = 0; k < 3 && next == kNone; ++k) {
      const int i = static_cast<int>((step + static_cast<std::size_t>(k)) % 3);
      if (orient2d(points_[triangle.v[(i + 1) % 3]], points_[triangle.v[(i + 2) % 3]], p) < 0) next = triangle.n[i];
    }
    if (next == kNone) return last_ = t;
    t = next;
  }
  for (t = 0; t < triangles_.size(); ++t) {
    const auto& v = triangles_[t].v;
    bool inside = true;
    for (int i = 0; i < 3; ++i) inside = inside && orient2d(points_[v[i]], points_[v[(i + 1) % 3]], p) >= 0;
    if (inside) return last_ = t;
  }
  throw std::logic_error("a point lies outside the triangulation");
}

std::uint32_t Triangulation::insert(const glm::dvec2& p) {
  const std::uint32_t t = locate(p);
  const Triangle old = triangles_[t];
  int on = -1;  // the corner opposite to the edge that p lies on
  for (int i = 0; i < 3; ++i) {
    if (points_[old.v[i]] == p) return old.v[i];
    if (orient2d(points_[old.v[(i + 1) % 3]], points_[old.v[(i + 2) % 3]], p) == 0) on = i;
  }
  const auto m = static_cast<std::uint32_t>(points_.size()), x = static_cast<std::uint32_t>(triangles_.size()),
             y = x + 1;
  points_.push_back(p);
  triangle_of_.push_back(t);
  ends_constraint_.push_back(false);
  if (on < 0) {
    const auto [a, b, c] = old.v;
    set(t, {m, b, c}, {old.n[0], x, y});
    set(x, {m, c, a}, {old.n[1], y, t});
    set(y, {m, a, b}, {old.n[2], t, x});
    replace_neighbour(old.n[1], t, x);
    replace_neighbour(old.n[2], t, y);
    legalise({t, x, y}, m);
    return m;
  }
  const std::uint32_t a = old.v[on], b = old.v[(on + 1) % 3], c = old.v[(on + 2) % 3], u = old.n[on];
  if (u == kNone) throw std::logic_error("a point lies on the border of the triangulation");
  const int j = side_to(u, t);
  const Triangle other = triangles_[u];
  const std::uint32_t d = other.v[j];  // other is d, c, b
  const std::uint32_t ca = old.n[(on + 1) % 3], ab = old.n[(on + 2) % 3], bd = other.n[(j + 1) % 3],
                      dc = other.n[(j + 2) % 3];
  if (const auto found = constraints_.find(key(b, c)); found != constraints_.end()) {
    const Crossing crossing = found->second;  // inherited by both halves, whose direction is that of bc
    const bool forward = b < c;
    constraints_.erase(found);
    for (const auto& [from, to] : {std::pair(b, m), std::pair(m, c)}) {
      const int sense = (from < to) == forward ? 1 : -1;
      constraint_of(from, to) = {sense * crossing.solid, sense * crossing.patch};
    }
  }
  set(t, {m, a, b}, {ab, u, x});
  set(x, {m, c, a}, {ca, t, y});
  set(y, {m, d, c}, {dc, x, u});
  set(u, {m, b, d}, {bd, y, t});
  replace_neighbour(ca, t, x);
  replace_neighbour(dc, u, y);
  legalise({t, x, y, u}, m);
  return m;
}

// Turns the diagonal of the quadrilateral of t and its neighbour opposite to corner i.
void Triangulation::flip(std::uint32_t t, int i) {
  const Triangle one = triangles_[t];
  const std::uint32_t u = one.n[i];
  const int j = side_to(u, t);
  const Triangle two = triangles_[u];
  const std::uint32_t p = one.v[i], a = one.v[(i + 1) % 3], b = one.v[(i + 2) % 3], q = two.v[j];
  const std::uint32_t bp = one.n[(i + 1) % 3], pa = one.n[(i + 2) % 3], aq = two.n[(j + 1) % 3],
                      qb = two.n[(j + 2) % 3];
  set(t, {p, a, q}, {aq, u, pa});
  set(u, {p, q, b}, {qb, bp, t});
  replace_neighbour(aq, u, t);
  replace_neighbour(bp, t, u);
}

// Lawson's flips around the new vertex p, which is a corner of each triangle on the stack.
void Triangulation::legalise(std::vector<std::uint32_t> around, std::uint32_t p) {
  while (!around.empty()) {
    const std::uint32_t t = around.back();
    around.pop_back();
    const int i = corner(t, p);
    const Triangle& triangle = triangles_[t];
    const std::uint32_t u = triangle.n[i];
    if (u == kNone || fixed(triangle.v[(i + 1) % 3], triangle.v[(i + 2) % 3])) continue;
    if (!in_circle(triangle, triangles_[u].v[side_to(u, t)])) continue;
    flip(t, i);
    around.push_back(t);
    around.push_back(u);
  }
}

std::pair<std::uint32_t, int> Triangulation::find_edge(std::uint32_t a, std::uint32_t b) const {
  const std::uint32_t start = triangle_of_[a];
  for (const int step : {1, 2}) {  // round a one way; the other way too where a is on the border
    std::uint32_t t = start;
    do {
      const int i = corner(t, a);
      if (triangles_[t].v[(i + 1) % 3] == b) return {t, (i + 2) % 3};
      t = triangles_[t].n[(i + step) % 3];
    } while (t != kNone && t != start);
    if (t == start) break;
  }
  return {kNone, 0};
}

}  // namespace meniscus

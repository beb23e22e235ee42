#include "meniscus/body.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "meniscus/predicates.h"

namespace meniscus {
namespace {

Hit make_hit(const Topology& mesh, std::uint32_t t, const glm::dvec3& p) {
  const glm::dvec3 n = mesh.area_normal(t);
  const double square = glm::dot(n, n);
  glm::dvec3 sum(0), bulge(0);
  for (int i = 0; i < 3; ++i) {  // by the areas opposite to the corners
    const glm::dvec3 a = mesh.corner(t, (i + 1) % 3) - p, b = mesh.corner(t, (i + 2) % 3) - p;
    const double weight = glm::dot(glm::cross(a, b), n) / square;
    const glm::dvec3 normal = mesh.triangles[t].normals[i];
    sum += weight * normal;
    bulge += weight * glm::dot(mesh.corner(t, i) - p, normal) * normal;
  }
  const double length = glm::length(sum);
  const glm::dvec3 facet = n / std::sqrt(square);
  // Half of what tangent planes at the corners ask for is an arc's distance from its chord (Boubekeur, Alexa 2008).
  return {p, facet, length > 0 ? sum / length : facet, p + 0.5 * bulge};
}

}  // namespace

std::optional<Hit> shoot(const Body& body, const glm::dvec3& origin, const glm::dvec3& direction, double expected,
                         double reach) {
  Box box;
  box.add(origin - reach * direction);
  box.add(origin + reach * direction);
  std::optional<std::pair<double, std::uint32_t>> best;
  body.tree.overlapping(box.grown(1e-9 * reach), [&](std::uint32_t t) {
    const glm::dvec3 n = body.mesh.area_normal(t);
    const double facing = glm::dot(n, direction);
    if (!(facing > 1e-9 * glm::length(n))) return;
    const double s = glm::dot(body.mesh.corner(t, 0) - origin, n) / facing;
    if (!(std::abs(s) <= reach)) return;
    const glm::dvec3 p = origin + s * direction;
    constexpr double kEdge = -1e-9;  // in parts of the facet
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 a = body.mesh.corner(t, i), b = body.mesh.corner(t, (i + 1) % 3);
      if (glm::dot(glm::cross(b - a, p - a), n) < kEdge * glm::dot(n, n)) return;
    }
    if (!best || std::abs(s - expected) < std::abs(best->first - expected)) best = {s, t};
  });
  if (!best) return {};
  return make_hit(body.mesh, best->second, origin + best->first * direction);
}

std::optional<Nearest> nearest_at_height(const Body& body, const glm::dvec3& origin, const glm::dvec3& up,
                                         const glm::dvec3& direction, double reach) {
  std::optional<Nearest> best;
  double least = reach;
  Box box;  // round the part of the plane within reach
  box.add(origin);
  box = box.grown(reach);
  const double slant = reach * std::sqrt(std::max(1 - up.y * up.y, 0.0));
  box.low.y = origin.y - slant, box.high.y = origin.y + slant;
  body.tree.overlapping(box, [&](std::uint32_t t) {
    const glm::dvec3 n = body.mesh.area_normal(t);
    if (!(glm::dot(n, direction) > 1e-9 * glm::length(n))) return;
    std::array<glm::dvec3, 3> ends;  // of the facet's segment in the plane
    std::size_t count = 0;
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 a = body.mesh.corner(t, i), b = body.mesh.corner(t, (i + 1) % 3);
      const double da = glm::dot(a - origin, up), db = glm::dot(b - origin, up);
      if ((da < 0) != (db < 0)) ends[count++] = a + da / (da - db) * (b - a);
    }
    if (count < 2) return;
    const glm::dvec3 e = ends[1] - ends[0];
    const double square = glm::dot(e, e);
    const double along = square > 0 ? glm::clamp(glm::dot(origin - ends[0], e) / square, 0.0, 1.0) : 0;
    const glm::dvec3 p = ends[0] + along * e;
    const double distance = glm::distance(p, origin);
    if (best ? distance >= least : distance > least) return;
    best = {make_hit(body.mesh, t, p), glm::dot(origin - p, n) < 0};
    least = distance;
  });
  return best;
}

double depth_within(const Body& body, const glm::dvec3& p) {
  Box above;
  above.add(p);
  const Box bounds = body.tree.bounds();
  if (!bounds.overlaps(above)) return 0;
  above.add({p.x, bounds.high.y, p.z});
  const glm::dvec2 x = planar(p);
  int winding = 0;
  body.tree.overlapping(above, [&](std::uint32_t t) {
    int round = 0;  // of the facet about the vertical line; half-open edges, so that neighbours never both have it
    for (int i = 0; i < 3; ++i) {
      const glm::dvec2 a = planar(body.mesh.corner(t, i)), b = planar(body.mesh.corner(t, (i + 1) % 3));
      if ((a.y > x.y) == (b.y > x.y)) continue;
      const bool rising = b.y > a.y;
      if (orient2d(rising ? a : b, rising ? b : a, x) > 0) round += rising ? 1 : -1;
    }
    if (round == 0) return;
    const glm::dvec3 n = body.mesh.area_normal(t);
    if (glm::dot(body.mesh.corner(t, 0) - p, n) * n.y > 0) winding += round;
  });
  if (winding == 0) return 0;
  return glm::distance(p, nearest_on_solid(body, p).position);
}

glm::dvec3 nearest_on_triangle(const Topology& mesh, std::uint32_t t, const glm::dvec3& p) {
  const glm::dvec3 n = mesh.area_normal(t);
  bool over = glm::dot(n, n) > 0;
  glm::dvec3 best = mesh.corner(t, 0);
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 a = mesh.corner(t, i), e = mesh.corner(t, (i + 1) % 3) - a;
    over = over && glm::dot(glm::cross(e, p - a), n) >= 0;
    const glm::dvec3 q = a + glm::clamp(glm::dot(p - a, e) / glm::dot(e, e), 0.0, 1.0) * e;
    if (glm::distance(p, q) < glm::distance(p, best)) best = q;
  }
  return over ? p - glm::dot(p - mesh.corner(t, 0), n) / glm::dot(n, n) * n : best;
}

Hit nearest_on_solid(const Body& body, const glm::dvec3& p) {
  std::pair<glm::dvec3, std::uint32_t> best{p, 0};
  double least = std::numeric_limits<double>::infinity();
  body.tree.nearest(p, least, [&](std::uint32_t t) {
    const glm::dvec3 q = nearest_on_triangle(body.mesh, t, p);
    if (glm::distance(p, q) < least) least = glm::distance(p, q), best = {q, t};
    return least;
  });
  return make_hit(body.mesh, best.second, best.first);
}

}  // namespace meniscus

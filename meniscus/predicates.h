// Exact signs of determinants of coordinates, and the one symbolic shift that removes every tie between a solid and a
// liquid. Needs a compiler that neither fuses nor reorders floating-point operations (-ffp-contract=off, no
// -ffast-math).
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace meniscus {

// The projection in which the liquid is re-meshed. (z, x) is counter-clockwise seen from above (+Y).
inline glm::dvec2 planar(const glm::dvec3& p) { return {p.z, p.x}; }
inline glm::dvec3 lifted(const glm::dvec2& p, double height) { return {p.y, height, p.x}; }
// The vector of the plane as the one tangent to a liquid with this normal above it.
inline glm::dvec3 tangent_to(const glm::dvec3& up, const glm::dvec2& v) {
  return lifted(v, -glm::dot(v, planar(up)) / up.y);
}

inline double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

// Sign (-1, 0, 1) of the turn a -> b -> c: positive when counter-clockwise. Exact; the first for doubtful cases.
int orient2d_exactly(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c);
inline int orient2d(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  const double left = (b.x - a.x) * (c.y - a.y), right = (b.y - a.y) * (c.x - a.x), turn = left - right;
  // Error bound: three roundings a product and one of the difference, with room to spare.
  if (std::abs(turn) > 1e-15 * (std::abs(left) + std::abs(right))) return turn > 0 ? 1 : -1;
  return orient2d_exactly(a, b, c);
}

// Sign of det[b - a, c - a, d - a]: positive when d is on the side to which the counter-clockwise normal of abc points.
// Exact.
int orient3d(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d);

// The same signs after the solid has been moved by an infinitesimal (e2, up * e1, e3), e1 >> e2 >> e3 > 0: never zero
// where it matters (a zero remains only for degenerate triangles and parallel edges, which then cannot cross). `up` is
// +1 or -1.
struct Shift {
  int up = 1;

  int solid_above_liquid(const glm::dvec3 liquid[3], const glm::dvec3& solid) const;
  int liquid_before_solid(const glm::dvec3 solid[3], const glm::dvec3& liquid) const;
  // Sense in which the solid's edge cd passes the liquid's edge ab: the sign of det[b - a, c - a, d - a].
  int edges(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) const;

 private:
  int tie(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) const;
};

}  // namespace meniscus

// How a path's place and direction change with where it starts (Igehy 1999; Schjoth et al. 2007): of a photon, along two perpendicular
// directions in its target's facet, per metre, or on its light; of a camera path, per pixel.
#include "reflection.glsl"

struct Differential {
  vec3 place0, place1, direction0, direction1;
};

// Light comes from a point at `distance`.
Differential start_differential(vec3 facet, vec3 direction, float distance) {
  vec3 u = tangent(facet), v = cross(facet, u);
  return Differential(u, v, (u - direction * dot(direction, u)) / distance, (v - direction * dot(direction, v)) / distance);
}

// While the start stays, and the point on an extended light moves along two perpendicular directions in its facet, per `extent`: the
// part of its distance, rad.
Differential light_differential(vec3 light_normal, float extent, vec3 direction) {
  vec3 u = tangent(light_normal), v = cross(light_normal, u);
  return Differential(vec3(0.0), vec3(0.0), extent * (direction * dot(direction, u) - u), extent * (direction * dot(direction, v) - v));
}

// Of a camera ray along `direction`, per pixel: `step0` and `step1` are a pixel's sides on the image plane, `distance` from the eye.
Differential camera_differential(vec3 step0, vec3 step1, vec3 direction, float distance, bool orthographic) {
  if (orthographic) return Differential(step0, step1, vec3(0.0), vec3(0.0));
  return Differential(vec3(0.0), vec3(0.0), (step0 - direction * dot(direction, step0)) / distance,
                      (step1 - direction * dot(direction, step1)) / distance);
}

vec3 reflect_derivative(vec3 dd, vec3 dn, vec3 direction, vec3 normal) {
  float dc = -dot(dd, normal) - dot(direction, dn);
  return dd + 2.0 * (dc * normal - dot(direction, normal) * dn);
}

// `beyond`: cosine of the refracted ray.
vec3 refract_derivative(vec3 dd, vec3 dn, vec3 direction, vec3 normal, float eta, float beyond) {
  float c = -dot(direction, normal);
  float dc = -dot(dd, normal) - dot(direction, dn);
  return eta * dd + (eta - eta * eta * c / beyond) * dc * normal + (eta * c - beyond) * dn;
}

// Over `distance` along `direction` onto a plane.
void transfer(inout Differential d, vec3 direction, float distance, vec3 plane) {
  vec3 slant = direction / dot(plane, direction);
  d.place0 += distance * d.direction0;
  d.place1 += distance * d.direction1;
  d.place0 -= dot(plane, d.place0) * slant;
  d.place1 -= dot(plane, d.place1) * slant;
}

// Twice the area of a triangle with these sides.
float twice_area(vec2 p, vec2 q) { return p.x * q.y - p.y * q.x; }

// Area that the parallelogram of the two derivatives of place spans.
float spread(Differential d) { return length(cross(d.place0, d.place1)); }

// Paths from an extended light lie in four dimensions, two of the start and two of the point on the light. Distances there go as the geometric
// mean of those between starts and the light's image where the photon lands (`image`: its area, m2), if that is wider. The factors were
// measured with lights of 0.6 to 6 degrees and 8,000 to 100,000 photons. Widens `reach`, the half-width of a disc in the facet that the
// path started on, m, and gives the half-width on the light, in units of its extent.
float widen(inout float reach, float image) {
  if (!(image > 0.0)) return 0.0;
  float extent = sqrt(image), ratio = sqrt(reach / extent);
  reach = max(reach, 2.0 * sqrt(reach * extent));
  return 0.5 * min(ratio, 1.0);
}

// The disc with the sum of the variances that half-widths of `reach` metres of start and `light_reach` extents of the light have, each
// half-width clamped: alpha and beta of PhotonDisc.
void make_disc(Differential d, float reach, Differential by_light, float light_reach, vec3 normal, float narrowest, float widest,
               out vec3 alpha, out vec3 beta) {
  vec3 u = tangent(normal), v = cross(normal, u);
  vec2 p = reach * vec2(dot(d.place0, u), dot(d.place0, v)), q = reach * vec2(dot(d.place1, u), dot(d.place1, v));
  // Sigma = J J^T, a symmetric matrix; its eigenvalues are the squared half-widths.
  float a = p.x * p.x + q.x * q.x, b = p.x * p.y + q.x * q.y, c = p.y * p.y + q.y * q.y;
  float area = abs(twice_area(p, q));  // root of the determinant
  if (HAS_EXTENDED && light_reach > 0.0) {
    vec2 r = light_reach * vec2(dot(by_light.place0, u), dot(by_light.place0, v));
    vec2 s = light_reach * vec2(dot(by_light.place1, u), dot(by_light.place1, v));
    a += r.x * r.x + s.x * s.x;
    b += r.x * r.y + s.x * s.y;
    c += r.y * r.y + s.y * s.y;
    // Of a product J J^T the determinant is the sum of the squares of J's minors (Cauchy and Binet).
    vec4 mixed = vec4(twice_area(p, r), twice_area(p, s), twice_area(q, r), twice_area(q, s));
    float lit = twice_area(r, s);
    area = sqrt(area * area + dot(mixed, mixed) + lit * lit);
  }
  float half_difference = 0.5 * (a - c), gap = sqrt(half_difference * half_difference + b * b);
  float wide = sqrt(0.5 * (a + c) + gap);
  float narrow = wide > 0.0 ? area / wide : 0.0;  // by the determinant: nothing cancels
  // At grazing incidence derivatives leave float's range: the disc is then as wide as it may be.
  if (!(wide < 1e18)) wide = narrow = widest;
  // The wide axis, from whichever row of Sigma - narrow^2 is longer; any axis where the disc is round.
  vec2 axis = half_difference >= 0.0 ? vec2(half_difference + gap, b) : vec2(b, gap - half_difference);
  float size = length(axis);
  axis = size > 1e-6 * wide * wide && size < 1e36 ? axis / size : vec2(1.0, 0.0);
  alpha = (axis.x * u + axis.y * v) / clamp(wide, narrowest, widest);
  beta = (axis.x * v - axis.y * u) / clamp(narrow, narrowest, widest);
}

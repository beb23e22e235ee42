// Points of a triangle that lights a point.
#ifndef MENISCAL_SEEN_TRIANGLE_H
#define MENISCAL_SEEN_TRIANGLE_H
#include "dialect.h"

SHARED_BEGIN

// A point of it. `solid_angle`: that it stands for, 1 / its density, sr; 0: the direction misses the triangle.
struct SeenPoint {
  vec3 direction;  // unit
  float distance;
  vec2 weights;  // of the second and third corner
  float solid_angle;
};

// By Van Oosterom and Strackee 1983, of unit vectors to the corners; sr.
SHARED float triangle_solid_angle(vec3 a, vec3 b, vec3 c) {
  return 2.0f * atan(abs(dot(a, cross(b, c))), 1.0f + dot(a, b) + dot(b, c) + dot(c, a));
}

// A direction, uniform in the spherical triangle (Arvo, "Stratified Sampling of Spherical Triangles", SIGGRAPH 1995), on the arc from b
// to a point of the side ac. Which should be the longest: near the opposite of b, points of ac would lie too densely for a float.
SHARED vec3 sample_arcs_from(vec3 a, vec3 b, vec3 c, float solid_angle, vec2 place) {
  vec3 ab = cross(a, b), ac = cross(a, c);
  float alpha = atan(length(cross(ab, ac)), dot(ab, ac));
  float s = sin(place.x * solid_angle - alpha), t = cos(place.x * solid_angle - alpha);
  float u = t - cos(alpha), v = s + sin(alpha) * dot(a, b);
  float below = (v * s + u * t) * sin(alpha);
  float q = below == 0.0f ? 1.0f : clamp(((v * t - u * s) * cos(alpha) - v) / below, -1.0f, 1.0f);
  vec3 d = q * a + sqrt(1.0f - q * q) * normalize(c - dot(c, a) * a);
  vec3 aside = d - dot(d, b) * b;
  float z = 1.0f - place.y * (1.0f - dot(d, b)), across = length(aside);
  return across == 0.0f ? b : z * b + sqrt(max(1.0f - z * z, 0.0f)) * (aside / across);
}

SHARED vec3 sample_spherical_triangle(vec3 a, vec3 b, vec3 c, float solid_angle, vec2 place) {
  float ab = dot(a, b), bc = dot(b, c), ca = dot(c, a);
  if (ab <= min(bc, ca)) return sample_arcs_from(a, c, b, solid_angle, place);
  if (bc <= ca) return sample_arcs_from(b, a, c, solid_angle, place);
  return sample_arcs_from(a, b, c, solid_angle, place);
}

// Seen from the origin. By area where it is small, by solid angle where area would leave nearly all of the light to few of the points.
// `place`: uniform in the unit square.
SHARED SeenPoint sample_seen_triangle(vec3 corner, vec3 edge1, vec3 edge2, vec2 place) {
  vec3 facing = cross(edge1, edge2);
  float height = dot(corner, facing), size2 = dot(facing, facing);
  vec3 middle = corner + (edge1 + edge2) / 3.0f;
  vec3 a = normalize(corner), b = normalize(corner + edge1), c = normalize(corner + edge2);
  float solid_angle = size2 > 4e-4f * dot(middle, middle) * dot(middle, middle) && height != 0.0f ? triangle_solid_angle(a, b, c) : 0.0f;
  SeenPoint seen;
  if (!(solid_angle > 1e-2f)) {
    float root = sqrt(place.x);
    seen.weights = vec2(1.0f - root, place.y * root);
    vec3 towards = corner + seen.weights.x * edge1 + seen.weights.y * edge2;
    seen.distance = length(towards);
    seen.direction = towards / seen.distance;
    seen.solid_angle = 0.5f * abs(height) / (seen.distance * seen.distance * seen.distance);
    return seen;
  }
  seen.solid_angle = solid_angle;
  if (solid_angle > 6.0f) {
    // Arvo's angles lose their digits where the triangle fills nearly all of a hemisphere, few of whose directions miss it.
    float sine = sqrt(1.0f - place.x * place.x), turn = 6.28318531f * place.y;
    vec3 across = normalize(edge1), axis = facing * (sign(height) / sqrt(size2));
    seen.direction = place.x * axis + sine * (cos(turn) * across + sin(turn) * cross(axis, across));
    seen.solid_angle = 6.28318531f;
  } else {
    seen.direction = sample_spherical_triangle(a, b, c, solid_angle, place);
  }
  seen.distance = height / dot(seen.direction, facing);
  vec3 inside = seen.direction * seen.distance - corner;
  seen.weights = vec2(dot(cross(inside, edge2), facing), dot(cross(edge1, inside), facing)) / size2;
  bool within = min(min(seen.weights.x, seen.weights.y), 1.0f - seen.weights.x - seen.weights.y) >= 0.0f;
  if (solid_angle > 6.0f && !within) seen.solid_angle = 0.0f;
  seen.weights = clamp(seen.weights, vec2(0.0f), vec2(1.0f));
  return seen;
}

SHARED_END
#endif

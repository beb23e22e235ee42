// Points of a triangle that lights a point, and how densely they lie: spread over its area, which costs least and is as good where all of
// it is about as far; or over the solid angle that it fills, where area would leave nearly all of its light to few of the points.
#ifndef MENISCAL_SEEN_TRIANGLE_H
#define MENISCAL_SEEN_TRIANGLE_H
#include "dialect.h"

SHARED_BEGIN

// From the origin. All but the angle holds only where that is not 0.
struct SeenTriangle {
  vec3 from, apex, to;  // unit vectors to the corners; the side opposite the apex is the longest
  float volume;         // that they span
  float angle;          // that directions are spread over evenly, sr; 0: points are spread over the area instead
};

const float SEEN_HEMISPHERE = 6.28318531f;

// Whether some of it is 1.5 times as far as other parts: no point of a triangle is far from both its middle and its corners.
SHARED bool is_wide(vec3 a, vec3 b, vec3 c) {
  vec3 middle = (a + b + c) / 3.0f;
  float a2 = dot(a, a), b2 = dot(b, b), c2 = dot(c, c), nearest2 = min(min(a2, b2), min(c2, dot(middle, middle)));
  return nearest2 > 0.0f && max(max(a2, b2), c2) > 2.25f * nearest2;
}

SHARED SeenTriangle see_triangle(vec3 corner, vec3 edge1, vec3 edge2) {
  SeenTriangle t;
  t.angle = 0.0f;
  vec3 second = corner + edge1, third = corner + edge2;
  if (!is_wide(corner, second, third)) return t;
  vec3 a = normalize(corner), b = normalize(second), c = normalize(third);
  float ab = dot(a, b), bc = dot(b, c), ca = dot(c, a);
  if (ca <= min(ab, bc)) t.from = a, t.apex = b, t.to = c;
  else if (ab <= bc) t.from = b, t.apex = c, t.to = a;
  else t.from = c, t.apex = a, t.to = b;
  // By Van Oosterom and Strackee 1983; by the edges and the longest side's ends together, which keep their digits where corners are
  // opposite one another.
  vec3 ends = t.from + t.to;
  float below = 0.5f * dot(ends, ends) + dot(t.apex, ends);
  t.volume = abs(dot(corner, cross(edge1, edge2))) / (length(corner) * length(second) * length(third));
  // Where a float cannot tell how it fills half of all directions, some of those are asked in vain.
  t.angle = max(t.volume, below) < 1e-4f ? SEEN_HEMISPHERE : 2.0f * atan(t.volume, below);
  if (t.volume == 0.0f || t.angle < 1e-3f) t.angle = 0.0f;  // in its plane, or a line: little light, and few digits
  return t;
}

// A direction, uniform in the spherical triangle: on the arc from the apex to the point of the longest side that cuts off this part of the
// solid angle (Peters, "BRDF Importance Sampling for Polygonal Lights", SIGGRAPH 2021). Near the opposite of the apex, points of that side
// would lie too densely for a float.
SHARED vec3 sample_arcs(SeenTriangle t, vec2 place) {
  float half_angle = 0.5f * t.angle * place.x, sine = sin(half_angle);
  float from_part = t.volume * cos(half_angle) - dot(t.to, t.from + t.apex) * sine, to_part = (1.0f + dot(t.from, t.apex)) * sine;
  vec3 halfway = from_part * t.from + to_part * t.to;
  vec3 side = 2.0f * dot(t.from, halfway) / dot(halfway, halfway) * halfway - t.from;
  float along = dot(side, t.apex), versine = place.y * (1.0f - along);
  vec3 aside = side - along * t.apex;
  float across = length(aside), sine2 = max(versine * (2.0f - versine), 0.0f);
  return across > 0.0f ? normalize((1.0f - versine) * t.apex + sqrt(sine2) / across * aside) : t.apex;
}

struct SeenPoint {
  vec3 direction;  // unit
  float distance;
  vec2 weights;  // of the second and third corner
  bool missed;   // the direction does not meet the triangle
};

// A point of one whose directions are spread evenly. `place`: uniform in the unit square.
SHARED SeenPoint sample_seen_triangle(SeenTriangle t, vec3 corner, vec3 edge1, vec3 edge2, vec2 place) {
  vec3 facing = cross(edge1, edge2);
  float height = dot(corner, facing);
  SeenPoint seen;
  if (t.angle == SEEN_HEMISPHERE) {
    float cosine = 1.0f - place.x, sine = sqrt(1.0f - cosine * cosine), turn = SEEN_HEMISPHERE * place.y;
    vec3 across = normalize(edge1), axis = normalize(height < 0.0f ? -facing : facing);
    seen.direction = cosine * axis + sine * (cos(turn) * across + sin(turn) * cross(axis, across));
  } else {
    seen.direction = sample_arcs(t, place);
  }
  float along = dot(seen.direction, facing);
  seen.distance = height / along;
  // By the planes through the sides: places on the triangle are rounded as it is wide.
  vec3 weights = vec3(dot(seen.direction, cross(corner + edge1, edge2 - edge1)), dot(seen.direction, cross(edge2, corner)),
                      dot(seen.direction, cross(corner, edge1))) / along;
  bool within = t.angle < SEEN_HEMISPHERE || min(weights.x, min(weights.y, weights.z)) >= 0.0f;
  seen.missed = !(within && seen.distance > 0.0f);
  seen.weights = clamp(vec2(weights.y, weights.z), vec2(0.0f), vec2(1.0f));
  return seen;
}

SHARED_END
#endif

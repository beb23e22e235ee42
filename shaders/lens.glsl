// Which place of a cell of a pixel sees which light, to first order, by the derivatives of a path that comes from `place` in it, both in
// units of the cell: as if the cell saw a plane. Is included after lights.glsl.
#include "coverage.glsl"
#include "shared/highlights.h"

struct Lens {
  vec3 centre, across, up;  // of the plane: where the path meets it, and its axes
  mat2 spread;              // of places in the plane by those in the cell
  vec2 place;
};

vec2 in_plane(Lens lens, vec3 v) { return vec2(dot(lens.across, v), dot(lens.up, v)); }

Lens make_lens(vec3 centre, vec3 normal, vec3 moved0, vec3 moved1, vec2 place) {
  vec3 across = tangent(normal);
  Lens lens = Lens(centre, across, cross(normal, across), mat2(0.0), place);
  lens.spread = mat2(in_plane(lens, moved0), in_plane(lens, moved1));
  return lens;
}

// Of directions, as places on the plane across the ray in the distance 1.
Lens make_lens(Path path, vec2 place) {
  Lens lens = make_lens(path.direction, path.direction, path.differential.direction0, path.differential.direction1, place);
  lens.spread += mat2(LEAST_CELL_ANGLE);
  return lens;
}

// Of points in the plane of this normal that the ray meets at a distance.
Lens make_lens(Path path, vec2 place, float distance, vec3 normal) {
  Differential d = path.differential;
  transfer(d, path.direction, distance, normal);
  return make_lens(path.origin + distance * path.direction, normal, d.place0, d.place1, place);
}

vec2 place_of(Lens lens, vec3 point) {
  mat2 m = lens.spread;
  vec2 v = in_plane(lens, point - lens.centre);
  return lens.place + vec2(v.x * m[1].y - v.y * m[1].x, v.y * m[0].x - v.x * m[0].y) / determinant(m);
}

vec3 seen_from(Lens lens, vec2 place) {
  vec2 at = lens.spread * (place - lens.place);
  return lens.centre + at.x * lens.across + at.y * lens.up;
}

// Mean radiance over the cell, before anything absorbs it, and which way a shadow ray asks for it.
struct Shining {
  vec3 radiance, direction;
  float distance, reach;  // to the light; of the shadow ray
};

const Shining NO_SHINING = Shining(vec3(0.0), vec3(0.0), 0.0, 0.0);

Shining see_area(Path path, vec2 place, Light light) {
  float facing = dot(path.direction, light.direction), along = dot(light.position - path.origin, light.direction) / facing;
  if (!(along > 0.0) || facing > 0.0 && light.double_sided == 0u) return NO_SHINING;
  Lens lens = make_lens(path, place, along, light.direction);
  Coverage coverage = Coverage(0.0, vec2(0.0));
  vec2 a = place_of(lens, light.position), b = place_of(lens, light.position + light.edge1), c = place_of(lens, light.position + light.edge2);
  add_edge(coverage, a, b);
  add_edge(coverage, b, c);
  add_edge(coverage, c, a);
  if (!(abs(coverage.area) > 0.0)) return NO_SHINING;
  vec3 point = seen_from(lens, coverage.moment / coverage.area), way = point - path.origin, inside = point - light.position;
  float distance = length(way), twice_area = dot(light.direction, cross(light.edge1, light.edge2));
  // Barycentric, of the second and third corner.
  vec2 weights = vec2(dot(light.direction, cross(inside, light.edge2)), dot(light.direction, cross(light.edge1, inside))) / twice_area;
  return Shining(abs(coverage.area) * light.intensity * emitted_part(light.triangle, weights), way / distance, distance,
                 distance * (1.0 - 1e-5));
}

// A light whose disc has an angular extent, if only the least one, as a regular polygon of the same area.
Shining see_disc(Path path, vec2 place, Light light, uint index) {
  const float certainly = 1.0;
  bool sun = index < SUNS;
  if (sun && light.cone_versine > MOST_VERSINE) return NO_SHINING;
  LightSample towards = sample_light(index, certainly, path.origin, vec2(0.0));
  if (sun) towards.direction = -light.direction;
  bool distant = towards.distance >= FAR;
  float versine = sun ? light.cone_versine : LEAST_VERSINE, sine = DISC_CIRCUMSCRIBED * sqrt(versine * (2.0 - versine));
  float along = dot(towards.direction, path.direction) * (distant ? 1.0 : towards.distance);
  Lens lens = make_lens(path, place);
  if (!distant) lens = make_lens(path, place, along, path.direction);
  Coverage coverage = Coverage(0.0, vec2(0.0));
  vec2 last = vec2(0.0);
  for (uint i = 0u; i <= DISC_CORNERS; ++i) {
    vec3 corner = around(towards.direction, sine, 1.0 - versine, float(i % DISC_CORNERS) / float(DISC_CORNERS));
    float ahead = dot(corner, path.direction);
    if (ahead < LEAST_AHEAD) return NO_SHINING;
    vec2 next = place_of(lens, distant ? corner / ahead : path.origin + along / ahead * corner);
    if (i > 0u) add_edge(coverage, last, next);
    last = next;
  }
  if (!(abs(coverage.area) > 0.0)) return NO_SHINING;
  if (sun) towards.direction = normalize(seen_from(lens, coverage.moment / coverage.area));
  return Shining(towards.irradiance * (abs(coverage.area) / (6.283185307179586 * versine)), towards.direction, towards.distance,
                 towards.distance);
}

// Where a beam's photons start: on its targets, or in a light's view of them.
#include "beams.glsl"

// A point of the beam's targets, uniform by area.
SurfacePoint start_point(Beam beam, uvec2 start) {
  float rest, weight;
  uint triangle = fetch_target(beam.target_first + pick(beam.target_first, beam.target_count, start.x, rest, weight));
  float root = sqrt(rest);
  return surface_point(triangle, 1.0 - root, unit_float(start.y) * root);
}

// In a distant light's view: before all of the scene, on the way through a place in the view. Those of an extended light go through it in
// directions that change with the start's third and fourth dimensions.
Path start_in_view(Beam beam, vec2 place, float power, RandomKey key) {
  Light light = fetch_light(beam.light);
  vec3 through = beam.corner + place.x * beam.u + place.y * beam.v, direction = light.direction;
  float extent = 0.0;
  if (HAS_SUNS && light.cone_versine > 0.0) {
    uvec2 bits = sobol_point_beyond(key);
    DistantSample s = sample_sun(light, vec2(unit_float(bits.x), unit_float(bits.y)));
    direction = -s.direction;
    extent = sqrt(s.solid_angle);
  }
  float cosine = dot(direction, light.direction), before = (1.01 * SCENE_RADIUS + dot(through, light.direction)) / cosine;
  Path path = start_path(through - before * direction, direction, NO_TRIANGLE, light.intensity * (power * cosine));
  if (HAS_DIFFERENTIALS) path.differential = start_differential(-light.direction, direction, FAR);
  if (HAS_DIFFERENTIALS && HAS_SUNS) {
    path.by_light = light_differential(direction, extent, direction);
    path.by_light.place0 = -before * path.by_light.direction0;
    path.by_light.place1 = -before * path.by_light.direction1;
  }
  return path;
}

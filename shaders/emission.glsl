// Photons as lights emit them: ordinary photon mapping, to compare with.
#include "scattering.glsl"

struct Emission {
  vec3 origin, direction;
  vec3 flux;      // of all photons
  uint triangle;  // of an area light
  uvec4 media;    // that the light is inside of
};

// From one of the lights, by power. `place`, uniform in the square: where on the disc across a distant light's direction, or where to from
// others.
Emission emit(vec2 place, uint light_first, uint light_count, RandomKey key) {
  float rest, weight;
  Light light = fetch_light(pick(light_first, light_count, random_bits(key, DIM_LIGHT), rest, weight));
  bool distant = HAS_DIRECTIONAL && light.type == LIGHT_DIRECTIONAL || HAS_ENVIRONMENT && light.type == LIGHT_ENVIRONMENT;
  Emission e = Emission(light.position, light.direction, light.intensity * weight, NO_TRIANGLE, light.media);
  if (distant) {
    DistantSample s = sample_distant(light, vec2(random_unit(key, DIM_LIGHT_U), random_unit(key, DIM_LIGHT_V)));
    e.direction = -s.direction;
    e.origin = SCENE_RADIUS * around(e.direction, sqrt(place.x), -1.01, place.y);
    e.flux = s.irradiance * (weight * 3.141592653589793 * SCENE_RADIUS * SCENE_RADIUS);
  } else if (HAS_AREA && light.type == LIGHT_AREA) {
    float root = sqrt(random_unit(key, DIM_LIGHT_U)), v = random_unit(key, DIM_LIGHT_V) * root;
    bool back = light.double_sided != 0u && random_unit(key, DIM_LIGHT_SIDE) < 0.5;
    vec3 side = back ? -light.direction : light.direction;
    e.direction = around(side, sqrt(place.x), sqrt(1.0 - place.x), place.y);
    e.origin = leave(light.position + (1.0 - root) * light.edge1 + v * light.edge2, side);
    e.flux *= 3.141592653589793 * light.area * (light.double_sided != 0u ? 2.0 : 1.0);
    e.flux *= emitted_part(light.triangle, vec2(1.0 - root, v));
    e.triangle = light.triangle;
  } else if (HAS_LOCAL) {
    float most = light.type == LIGHT_SPOT ? light.cone_versine : 2.0, versine = most * place.x;
    float falloff = light.type == LIGHT_SPOT ? clamp((light.cone_versine - versine) * light.cone_scale, 0.0, 1.0) : 1.0;
    vec3 axis = light.type == LIGHT_SPOT ? light.direction : vec3(0.0, 1.0, 0.0);
    e.direction = around(axis, sqrt(versine * (2.0 - versine)), 1.0 - versine, place.y);
    e.flux *= 6.283185307179586 * most * falloff * falloff;
  }
  return e;
}

// Sampling the lights from a point.
#include "optics.glsl"

struct LightSample {
  vec3 direction;      // from the point towards the light
  float distance;      // to the light sample; directional: beyond the scene
  vec3 irradiance;     // on a surface facing the light, over the probability (density) of this sample; 0: not emitted this way
  uint triangle;       // of an area light, else NO_TRIANGLE
};

const float FAR = 1e30;

LightSample sample_light(vec3 point, uint first, uint count, RandomKey key) {
  float rest;
  uint index = pick(first, count, random_bits(key, DIM_LIGHT), rest);
  Light light = lights[index];
  LightSample s = LightSample(-light.direction, FAR, light.intensity / light.probability, NO_TRIANGLE);
  if (HAS_AREA && light.type == LIGHT_AREA) {
    float root = sqrt(random_unit(key, DIM_LIGHT_U)), v = random_unit(key, DIM_LIGHT_V) * root;
    vec3 on_light = light.position + (1.0 - root) * light.edge1 + v * light.edge2;
    vec3 towards = on_light - point;
    s.distance = length(towards);
    s.direction = towards / s.distance;
    float cosine = -dot(s.direction, light.direction);
    if (light.double_sided != 0u) cosine = abs(cosine);
    s.irradiance *= max(cosine, 0.0) * light.area / (s.distance * s.distance);
    s.triangle = light.triangle;
  } else if (HAS_LOCAL && light.type != LIGHT_DIRECTIONAL) {
    vec3 towards = light.position - point;
    s.distance = length(towards);
    s.direction = towards / s.distance;
    s.irradiance /= s.distance * s.distance;
    if (light.type == LIGHT_SPOT) {
      vec3 chord = s.direction + light.direction;
      float falloff = clamp((light.cone_versine - 0.5 * dot(chord, chord)) * light.cone_scale, 0.0, 1.0);
      s.irradiance *= falloff * falloff;
    }
  }
  return s;
}

// Whether nothing at all, specular surfaces included, stands between the point and the light sample.
bool visible(vec3 point, uint triangle, vec3 side, LightSample s) {
  vec3 origin = leave(point, side);
  float reach = s.triangle == NO_TRIANGLE ? s.distance : s.distance * (1.0 - 1e-5);
  return intersect(origin, s.direction, reach, triangle, true).triangle == NO_TRIANGLE;
}

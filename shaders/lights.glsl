// Sampling the lights from a point.
#include "optics.glsl"

struct LightSample {
  vec3 direction;      // from the point towards the light
  float distance;      // to the light sample; directional: beyond the scene
  vec3 irradiance;     // on a surface facing the light, over the probability (density) of this sample; 0: not emitted this way
  uint triangle;       // of an area light, else NO_TRIANGLE
};

const float FAR = 1e30;

// `weight`: 1 / probability of having chosen this light.
LightSample sample_light(uint index, float weight, vec3 point, RandomKey key) {
  Light light = fetch_light(index);
  LightSample s = LightSample(-light.direction, FAR, light.intensity * weight, NO_TRIANGLE);
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
      // The versine by way of the sine, which keeps its digits near the axis.
      vec3 sine = cross(s.direction, light.direction);
      float cosine = -dot(s.direction, light.direction);
      float versine = cosine > 0.0 ? dot(sine, sine) / (1.0 + cosine) : 1.0;
      float falloff = clamp((light.cone_versine - versine) * light.cone_scale, 0.0, 1.0);
      s.irradiance *= falloff * falloff;
    }
  }
  return s;
}

// One of the lights, by the CDF that begins at `first`.
LightSample sample_lights(vec3 point, uint first, uint count, RandomKey key) {
  float rest, weight;
  uint index = pick(first, count, random_bits(key, DIM_LIGHT), rest, weight);
  return sample_light(index, weight, point, key);
}

// How far a shadow ray must be free, so that the emitting triangle does not shadow itself.
float shadow_reach(LightSample s) { return s.triangle == NO_TRIANGLE ? s.distance : s.distance * (1.0 - 1e-5); }

// Sampling the lights from a point.
#include "sky.glsl"
#include "shared/seen_triangle.h"

struct LightSample {
  vec3 direction;      // from the point towards the light
  float distance;      // to the light sample; directional: beyond the scene
  vec3 irradiance;     // on a surface facing the light, over the probability (density) of this sample; 0: not emitted this way
  uint triangle;       // of an area light, else NO_TRIANGLE
  vec3 normal;         // of an extended light: of its facet, or along its direction
  float extent;        // of an extended light: root of its solid angle over the probability (density) of this sample, rad; else 0
  uvec4 media;         // that the light is inside of
};

// The solid angle that a point of a seen triangle stands for, 1 / its density, sr.
float angle_of_sample(SeenTriangle seen, float area, float distance, float cosine) {
  return seen.angle > 0.0 ? seen.angle : area * cosine / (distance * distance);
}

// `weight`: 1 / probability of having chosen this light. `place`, uniform in the unit square: picks the point of an extended light.
LightSample sample_light(uint index, float weight, vec3 point, vec2 place) {
  Light light = fetch_light(index);
  LightSample s = LightSample(-light.direction, FAR, light.intensity * weight, NO_TRIANGLE, light.direction, 0.0, light.media);
  if (HAS_AREA && light.type == LIGHT_AREA) {
    vec3 corner = light.position - point;
    SeenTriangle seen = see_triangle(corner, light.edge1, light.edge2);
    vec2 weights;
    bool missed = false;
    if (seen.angle > 0.0) {
      SeenPoint there = sample_seen_triangle(seen, corner, light.edge1, light.edge2, place);
      s.direction = there.direction, s.distance = there.distance, weights = there.weights, missed = there.missed;
    } else {
      float root = sqrt(place.x);
      weights = vec2(1.0 - root, place.y * root);
      vec3 towards = light.position + weights.x * light.edge1 + weights.y * light.edge2 - point;
      s.distance = length(towards);
      s.direction = towards / s.distance;
    }
    float cosine = -dot(s.direction, light.direction), angle = angle_of_sample(seen, light.area, s.distance, abs(cosine));
    if (missed || light.double_sided == 0u && cosine <= 0.0) angle = 0.0;
    s.irradiance *= angle * emitted_part(light.triangle, weights);
    s.triangle = light.triangle;
    s.extent = seen.angle > 0.0 ? min(sqrt(seen.angle * weight / abs(cosine)), MOST_EXTENT) : sqrt(light.area * weight) / s.distance;
  } else if (HAS_LOCAL && (light.type == LIGHT_POINT || light.type == LIGHT_SPOT)) {
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
  } else if (HAS_SUNS || HAS_ENVIRONMENT) {
    DistantSample distant = sample_distant(light, place);
    s.direction = distant.direction;
    s.irradiance = distant.irradiance * weight;
    s.normal = -s.direction;
    s.extent = min(sqrt(distant.solid_angle * weight), MOST_EXTENT);
  }
  return s;
}

// One of the lights, by the CDF that begins at `first`, for a photon: light and point by the sequence that its start is of, in the third
// and fourth dimensions.
LightSample sample_lights(vec3 point, uint first, uint count, RandomKey key) {
  uvec2 bits = HAS_EXTENDED ? sobol_point_beyond(key) : uvec2(random_bits(key, DIM_LIGHT), 0u);
  float rest, weight;
  uint index = pick(first, count, bits.x, rest, weight);
  return sample_light(index, weight, point, vec2(rest, unit_float(bits.y)));
}

// The i-th of the lights that a surface of this normal asks, of LIGHTS_ASKED, if there are as many: the sum of their irradiances stands for
// all. Where there are more, each is the likelier, the more it would give the surface if nothing stood between; of all lights, or of
// LIGHT_CANDIDATES picked by power (Talbot et al., "Importance Resampling for Global Illumination", EGSR 2005).
LightSample choose_light(vec3 point, vec3 normal, uint first, uint count, RandomKey key, uint i) {
  vec2 place = vec2(unit_float(light_bits(key, DIM_LIGHT_U, i)), unit_float(light_bits(key, DIM_LIGHT_V, i)));
  if (count <= LIGHTS_ASKED) return sample_light(i, 1.0, point, place);
  uint candidates = min(count, LIGHT_CANDIDATES);
  float choice = unit_float(light_bits(key, DIM_LIGHT_SIDE, i)), sum = 0.0, kept = 0.0;
  LightSample chosen;
  for (uint c = 0u; c < candidates; ++c) {
    uint index = c;
    float weight = 1.0, rest;
    if (candidates < count) {
      index = pick(first, count, light_bits(key, DIM_LIGHT, i) + c * (0xFFFFFFFFu / candidates), rest, weight);
      weight /= float(candidates);
    }
    LightSample s = sample_light(index, weight, point, place);
    float given = dot(s.irradiance, vec3(1.0)) * max(dot(s.direction, normal), 0.0);
    if (c == 0u) chosen = s;
    if (!(given > 0.0)) continue;
    sum += given;
    bool taken = choice * sum < given;
    choice = clamp(taken ? choice * sum / given : (choice * sum - given) / (sum - given), 0.0, 1.0);
    if (taken) {
      chosen = s;
      kept = given;
    }
  }
  if (kept > 0.0) chosen.irradiance *= sum / (kept * float(LIGHTS_ASKED));
  return chosen;
}

// How far a shadow ray must be free that starts at `origin`, off the point that was lit, so that the emitting triangle does not shadow
// itself.
float shadow_reach(LightSample s, vec3 point, vec3 origin) {
  if (s.triangle == NO_TRIANGLE) return s.distance;
  return s.distance * (1.0 - 1e-5) - abs(dot(origin - point, s.normal) / dot(s.direction, s.normal));
}

// Index + 1 of the area light that a triangle is; 0: none.
uint light_of(uint triangle) { return FETCH(scene, 4u * (TRIANGLE_BASE + triangle) + 2u).w; }

// The density, per solid angle, with which a light picked by power gives a point the direction of one on a triangle, at `distance` under
// `cosine` to the triangle's normal. 0: no light. Shares out what both shadow rays and lobes find: any function would do that both know.
float area_light_pdf(uint triangle, vec3 point, float distance, float cosine) {
  if (!HAS_AREA) return 0.0;
  uint light = light_of(triangle);
  if (light == 0u) return 0.0;
  Light l = fetch_light(light - 1u);
  return l.probability / angle_of_sample(see_triangle(l.position - point, l.edge1, l.edge2), l.area, distance, cosine);
}

// The same of a light sample. 0: a point or a direction, which no path meets by chance.
float asked_pdf(LightSample s, vec3 point) {
  if (s.extent == 0.0) return 0.0;
  if (s.triangle == NO_TRIANGLE) return sky(s.direction, false).pdf;
  return area_light_pdf(s.triangle, point, s.distance, abs(dot(s.normal, s.direction)));
}

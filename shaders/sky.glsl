// What lies beyond the scene: suns (directional lights with an angular diameter) and the environment, an image of all directions. Lights to
// be sampled, and what rays that leave the scene see.
#include "optics.glsl"
#include "shared/highlights.h"

FETCH_TABLE(BIND_ENVIRONMENT, environment)

const float FAR = 1e30;  // beyond the scene
// Of a photon's footprint by the light, rad: derivatives tell nothing of wider ones.
const float MOST_EXTENT = 1.0;

vec3 around(vec3 axis, float sine, float cosine, float turn) {
  vec3 u = tangent(axis), v = cross(axis, u);
  vec2 place = circle(turn);
  return cosine * axis + sine * (place.x * u + place.y * v);
}

struct DistantSample {
  vec3 direction;     // towards the light
  vec3 irradiance;    // on a surface facing it, over the density of this direction
  float solid_angle;  // 1 / that density; 0: there is but one direction
};

float sun_solid_angle(Light sun) { return 6.283185307179586 * sun.cone_versine; }

// Uniform in the sun's cone.
DistantSample sample_sun(Light sun, vec2 place) {
  float versine = sun.cone_versine * place.x;
  return DistantSample(around(-sun.direction, sqrt(versine * (2.0 - versine)), 1.0 - versine, place.y), sun.intensity, sun_solid_angle(sun));
}

// The environment's pixels have one radiance each, and are taken by radiance times solid angle: the row by place.x, in it the column by
// place.y, what is left of both is the place in the pixel. Its middle looks along +X, its columns go on towards +Z, its top is +Y.
DistantSample sample_environment(vec2 place) {
  float down, right, weight;
  uint row = pick(ENVIRONMENT_FIRST, ENVIRONMENT_ROWS, uint(place.x * 4294967296.0), down, weight);
  uint columns = ENVIRONMENT_FIRST + ENVIRONMENT_ROWS + row * ENVIRONMENT_COLUMNS;
  uint column = pick(columns, ENVIRONMENT_COLUMNS, uint(place.y * 4294967296.0), right, weight);
  uvec4 pixel = FETCH(environment, row * ENVIRONMENT_COLUMNS + column);
  // Uniform in solid angle: in the versine from +Y.
  float half_row = 0.25 / float(ENVIRONMENT_ROWS), high = circle(half_row * float(row)).y, low = circle(half_row * float(row + 1u)).y;
  float versine = 2.0 * mix(high * high, low * low, down), sine = sqrt(max(versine * (2.0 - versine), 0.0));
  vec2 azimuth = circle((float(column) + right) / float(ENVIRONMENT_COLUMNS) - 0.5 - ENVIRONMENT_TURN);
  float solid_angle = 1.0 / uintBitsToFloat(pixel.w);
  return DistantSample(vec3(sine * azimuth.x, 1.0 - versine, sine * azimuth.y), uintBitsToFloat(pixel.xyz) * solid_angle, solid_angle);
}

DistantSample sample_distant(Light light, vec2 place) {
  if (HAS_ENVIRONMENT && light.type == LIGHT_ENVIRONMENT) return sample_environment(place);
  if (HAS_SUNS && light.cone_versine > 0.0) return sample_sun(light, place);
  return DistantSample(-light.direction, light.intensity, 0.0);
}

struct SkySample {
  vec3 radiance;
  float pdf;  // density, per solid angle, with which a light picked by power gives this direction (see area_light_pdf)
};

// What a ray sees that leaves the scene; `in_meniscus`: but for suns that highlights show.
SkySample sky(vec3 direction, bool in_meniscus) {
  SkySample s = SkySample(vec3(0.0), 0.0);
  for (uint i = 0u; i < SUNS; ++i) {
    Light sun = fetch_light(i);
    if (in_meniscus && sun.cone_versine <= MOST_VERSINE) continue;
    vec3 off = direction + sun.direction;
    if (0.5 * dot(off, off) >= sun.cone_versine) continue;  // the versine between unit vectors
    s.radiance += sun.intensity / sun_solid_angle(sun);
    s.pdf += sun.probability / sun_solid_angle(sun);
  }
  if (HAS_ENVIRONMENT) {
    float across = fract(atan(direction.z, direction.x) * 0.159154943091895 + 0.5 + ENVIRONMENT_TURN);
    float down = atan(length(direction.xz), direction.y) * 0.318309886183791;
    uint column = min(uint(across * float(ENVIRONMENT_COLUMNS)), ENVIRONMENT_COLUMNS - 1u);
    uint row = min(uint(down * float(ENVIRONMENT_ROWS)), ENVIRONMENT_ROWS - 1u);
    uvec4 pixel = FETCH(environment, row * ENVIRONMENT_COLUMNS + column);
    s.radiance += uintBitsToFloat(pixel.xyz);
    s.pdf += fetch_light(SUNS).probability * uintBitsToFloat(pixel.w);
  }
  return s;
}

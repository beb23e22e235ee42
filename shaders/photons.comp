#version 460
#extension GL_GOOGLE_include_directive : require
// One photon: starts on a target triangle, is lit from there, and ends at the first diffuse surface. Paper, section 4.2.1.
#include "lights.glsl"
#include "shared/geometry.h"

layout(push_constant) uniform Push { PhotonPush push; };
layout(set = 0, binding = BIND_OUTPUT, std430) writeonly buffer Places { PhotonPlace places[]; };
layout(set = 0, binding = BIND_OUTPUT + 1, std430) writeonly buffer Powers { PhotonPower powers[]; };
layout(set = 0, binding = BIND_OUTPUT + 2, std430) writeonly buffer Keys { uint keys[]; };
layout(set = 0, binding = BIND_OUTPUT + 3, std430) writeonly buffer Entered { float entered[]; };  // mean flux at the target

// Follows the path from its first specular surface; leaves its end in `power` and, where it was stored, `place` and `key`.
void trace(Path path, uint triangle, vec3 point, vec3 shading, RandomKey random, inout PhotonPlace place, inout PhotonPower power,
           inout uint key) {
  power.end = END_CUT;
  for (uint bounce = 0u; bounce < push.specular_bounces; ++bounce) {
    uint dimension = DIM_FIRST_BOUNCE + BOUNCE_DIMENSIONS * bounce;
    Surface surface = surfaces[triangle_material(triangle)];
    vec3 normal = geometric_normal(triangle);
    if (dot(normal, path.direction) > 0.0) normal = -normal;
    if (random_unit(random, dimension) >= surface.specular) {
      // A photon that starts at a partly diffuse target and is scattered there at once has met no specular surface.
      if (bounce > 0u) {
        place = PhotonPlace(point, pack_direction(normal));
        key = cell_key(grid_cell(point, push.cell_size), push.cell_mask);
      }
      power.end = bounce > 0u ? triangle : END_DROPPED;
      break;
    }
    scatter_specular(path, point, triangle, shading, surface, random_unit(random, dimension + 1u));
    Hit hit = intersect(path.origin, path.direction, FAR, path.triangle, false);
    if (hit.triangle == NO_TRIANGLE) {
      power.end = END_ESCAPED;
      break;
    }
    absorb(path, hit.t);
    triangle = hit.triangle;
    point = triangle_point(triangle, hit.u, hit.v);
    shading = shading_normal(triangle, hit.u, hit.v);
  }
  power.flux = path.throughput;
}

void main() {
  uint i = invocation_index();
  if (i >= push.count) return;
  uint slot = push.first + i;
  RandomKey random = RandomKey(push.seed, push.pass, push.stream, slot);

  uvec2 start = sobol_point(random);
  float rest;
  uint triangle = targets[push.target_first + pick(push.target_first, push.target_count, start.x, rest)];
  float root = sqrt(rest), v = unit_float(start.y) * root;
  float u = 1.0 - root;
  vec3 point = triangle_point(triangle, u, v);
  vec3 geometric = geometric_normal(triangle);

  PhotonPlace place = PhotonPlace(point, 0u);
  PhotonPower power = PhotonPower(vec3(0.0), END_BLOCKED);
  uint key = NO_CELL;
  LightSample light = sample_light(point, push.light_first, push.light_count, random);
  float cosine = dot(light.direction, geometric);
  power.flux = light.irradiance * push.power_scale;
  if (random_unit(random, DIM_COSINE) >= abs(cosine)) {
    power.end = END_DROPPED;
  } else if (any(greaterThan(light.irradiance, vec3(0.0))) &&
             visible(point, triangle, cosine > 0.0 ? geometric : -geometric, light)) {
    Path path = Path(point, -light.direction, triangle, power.flux, vec3(0.0), 1.0);
    if (HAS_ABSORPTION && cosine < 0.0 && light.distance < FAR) {
      path.absorption = surfaces[triangle_material(triangle)].absorption;
      absorb(path, light.distance);
    }
    trace(path, triangle, point, shading_normal(triangle, u, v), random, place, power, key);
  }
  entered[slot] = dot(light.irradiance, vec3(push.power_scale / 3.0));
  places[slot] = place;
  powers[slot] = power;
  keys[slot] = key;
  atomicAdd(counters[COUNTER_RAYS], rays_traced);
}

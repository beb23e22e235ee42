#version 460
#extension GL_GOOGLE_include_directive : require
// One photon: starts on a target triangle, is lit from there, and ends at the first diffuse surface. Paper, section 4.2.1.
#include "lights.glsl"
#include "shared/geometry.h"

layout(push_constant) uniform Push { PhotonPush push; };
layout(set = 0, binding = BIND_OUTPUT, std430) writeonly buffer Ends { PhotonEnd ends[]; };
layout(set = 0, binding = BIND_OUTPUT + 1, std430) writeonly buffer Discs { PhotonDisc discs[]; };
layout(set = 0, binding = BIND_OUTPUT + 2, std430) writeonly buffer Keys { uint keys[]; };

// A point of the stratum, uniform by area.
SurfacePoint start_point(RandomKey random) {
  uvec2 start = sobol_point(random);
  float rest;
  uint triangle = targets[push.target_first + pick(push.target_first, push.target_count, start.x, rest)];
  float root = sqrt(rest);
  return surface_point(triangle, 1.0 - root, unit_float(start.y) * root);
}

// The photon's footprint on the surface it is stored on, and the cell of the hash grid.
void store(uint slot, Differential d, vec3 position, vec3 side) {
  PhotonDisc disc;
  make_disc(d, side, push.reach, push.narrowest, push.widest, disc.alpha, disc.beta);
  float half_width = inversesqrt(min(dot(disc.alpha, disc.alpha), dot(disc.beta, disc.beta)));
  uint level = 0u;
  while (level + 1u < GRID_LEVELS && 1.00001 * half_width > 1.00002 * push.narrowest * float(1u << level)) level += 1u;
  discs[slot] = disc;
  keys[slot] = cell_key(grid_cell(position, level_cell_size(push.narrowest, level)), level, push.cell_mask);
}

void main() {
  uint i = invocation_index();
  if (i >= push.count) return;
  uint slot = push.first + i;
  RandomKey random = RandomKey(push.seed, push.pass, push.stream, slot);
  keys[slot] = NO_CELL;

  // The first ray looks for the target in the light's view, or, from a point of the target, for the light. What it meets, the light's
  // cosine there is a factor on the flux: the paper's roulette has the same mean, but would undo the starts' stratification.
  bool in_view = push.view_corner.w != 0.0;
  SurfacePoint point;
  Path path;
  LightSample light;
  if (in_view) {
    uvec2 start = sobol_point(random);
    path.origin = push.view_corner.xyz + unit_float(start.x) * push.view_u.xyz + unit_float(start.y) * push.view_v.xyz;
    light = sample_light(path.origin, push.light_first, push.light_count, random);
    path = start_path(path.origin, -light.direction, NO_TRIANGLE, light.irradiance * push.power_scale);
    if (HAS_DIFFERENTIALS) path.differential = start_differential(-light.direction, -light.direction, FAR);
    point.position = path.origin;
  } else {
    point = start_point(random);
    light = sample_light(point.position, push.light_first, push.light_count, random);
    float cosine = dot(light.direction, point.geometric);
    path = start_path(leave(point.position, cosine > 0.0 ? point.geometric : -point.geometric), light.direction, point.triangle,
                      light.irradiance * (abs(cosine) * push.power_scale));
    if (HAS_DIFFERENTIALS) path.differential = start_differential(point.geometric, -light.direction, light.distance);
  }
  float entered = dot(path.throughput, vec3(1.0 / 3.0));
  uint end = entered > 0.0 ? END_CUT : END_BLOCKED;

  for (uint k = 0u; k <= push.specular_bounces && end == END_CUT; ++k) {
    bool asks_light = k == 0u && !in_view;
    Hit hit = intersect(path.origin, path.direction, asks_light ? shadow_reach(light) : FAR, path.triangle, asks_light);
    if (asks_light) {
      if (hit.triangle != NO_TRIANGLE) end = END_BLOCKED;
      path.direction = -light.direction;
      if (HAS_ABSORPTION && dot(light.direction, point.geometric) < 0.0 && light.distance < FAR) {
        path.absorption = surfaces[point.material].absorption;
        absorb(path, light.distance);
        entered = dot(path.throughput, vec3(1.0 / 3.0));
      }
    } else if (hit.triangle == NO_TRIANGLE) {
      end = k == 0u ? END_DROPPED : END_ESCAPED;
    } else {
      absorb(path, hit.t);
      point = surface_point(hit.triangle, hit.u, hit.v);
      if (HAS_DIFFERENTIALS) transfer(path.differential, path.direction, hit.t, point.geometric);
    }
    if (end != END_CUT) break;

    Surface surface = surfaces[point.material];
    // What the light sees first in its view may be another stratum's, or nothing that photons start on.
    if (k == 0u && (surface.specular == 0.0 || (point.meniscus != 0u) != (push.stream == STREAM_TARGETED))) {
      end = END_DROPPED;
      break;
    }
    uint dimension = DIM_FIRST_BOUNCE + BOUNCE_DIMENSIONS * k;
    if (random_unit(random, dimension) >= surface.specular) {
      // A photon that its target scatters diffusely at once has met no specular surface.
      end = k > 0u ? point.triangle : END_DROPPED;
      vec3 side = dot(point.geometric, path.direction) > 0.0 ? -point.geometric : point.geometric;
      if (k > 0u) store(slot, path.differential, point.position, side);
    } else if (k < push.specular_bounces) {
      scatter_specular(path, point, surface, random_unit(random, dimension + 1u));
    }
  }
  ends[slot] = PhotonEnd(point.position, end, path.throughput, entered);
  atomicAdd(counters[COUNTER_RAYS], rays_traced);
}

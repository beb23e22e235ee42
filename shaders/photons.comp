#version 460
#extension GL_GOOGLE_include_directive : require
// One photon: starts on a target, or where a light sees one, and ends at the first diffuse surface. Paper, section 4.2.1.
#include "emission.glsl"
#include "shared/geometry.h"
#include "shared/starts.h"

layout(push_constant) uniform Push { PhotonPush push; };
layout(set = 0, binding = BIND_OUTPUT, std430) writeonly buffer Ends { PhotonEnd ends[]; };
layout(set = 0, binding = BIND_OUTPUT + 1, std430) writeonly buffer Discs { PhotonDisc discs[]; };
layout(set = 0, binding = BIND_OUTPUT + 2, std430) writeonly buffer Keys { uint keys[]; };
layout(set = 0, binding = BIND_OUTPUT + 3, std430) readonly buffer Beams { Beam beams[]; };

// A point of the beam's targets, uniform by area.
SurfacePoint start_point(Beam beam, uvec2 start) {
  float rest, weight;
  uint triangle = targets[beam.target_first + pick(beam.target_first, beam.target_count, start.x, rest, weight)];
  float root = sqrt(rest);
  return surface_point(triangle, 1.0 - root, unit_float(start.y) * root);
}

// The photon's footprint on the surface it is stored on, and the cell of the hash grid.
void store(uint slot, Differential d, float reach, vec3 position, vec3 side) {
  PhotonDisc disc;
  make_disc(d, side, reach, push.narrowest, push.widest, disc.alpha, disc.beta);
  float half_width = inversesqrt(min(dot(disc.alpha, disc.alpha), dot(disc.beta, disc.beta)));
  uint level = 0u;
  while (level + 1u < GRID_LEVELS && 1.00001 * half_width > 1.00002 * push.narrowest * float(1u << level)) level += 1u;
  discs[slot] = disc;
  keys[slot] = cell_key(grid_cell(position, level_cell_size(push.narrowest, level)), level, push.cell_mask);
}

void main() {
  uint i = invocation_index();
  if (i >= push.count) return;
  uint photon = push.first + i, slot = photon - push.buffer_first;
  uint b = 0u;
  while (b + 1u < push.beams && photon >= beams[b + 1u].first) b += 1u;
  Beam beam = beams[b];
  RandomKey random = RandomKey(push.seed, push.pass, STREAM_BEAM + b, photon - beam.first);
  keys[slot] = NO_CELL;

  uvec2 start = start_bits(random, beam.start, beam.extent);
  vec2 place = vec2(unit_float(start.x), unit_float(start.y));
  float power = beam.power * (window_weight(place, beam.own, beam.own_fade) - window_weight(place, beam.finer, beam.finer_fade));

  // The first ray looks for the target in the light's view, or, from a point of the target, for the light. What it meets, the light's
  // cosine there is a factor on the flux: the paper's roulette has the same mean, but would undo the starts' stratification.
  bool on_targets = beam.kind == START_ON_TARGETS;
  uint map = beam.map;
  SurfacePoint point;
  Path path;
  LightSample light;
  if (HAS_EMISSION && beam.kind == START_ON_LIGHTS) {
    Emission e = emit(place, beam.light_first, push.light_count, random);
    path = start_path(e.origin, e.direction, e.triangle, e.flux * power);
    point.position = path.origin;
  } else if (beam.kind == START_IN_VIEW) {
    path.origin = beam.corner + place.x * beam.u + place.y * beam.v;
    light = sample_light(beam.light, 1.0, path.origin, random);
    path = start_path(path.origin, -light.direction, NO_TRIANGLE, light.irradiance * power);
    if (HAS_DIFFERENTIALS) path.differential = start_differential(-light.direction, -light.direction, FAR);
    point.position = path.origin;
  } else {
    point = start_point(beam, start);
    light = sample_lights(point.position, beam.light_first, push.light_count, random);
    float cosine = dot(light.direction, point.geometric);
    path = start_path(leave(point.position, cosine > 0.0 ? point.geometric : -point.geometric), light.direction, point.triangle,
                      light.irradiance * (abs(cosine) * power));
    if (HAS_DIFFERENTIALS) path.differential = start_differential(point.geometric, -light.direction, light.distance);
  }
  float entered = dot(path.throughput, vec3(1.0 / 3.0));
  uint end = entered > 0.0 ? END_CUT : on_targets ? END_BLOCKED : END_DROPPED;

  for (uint k = 0u; k <= push.specular_bounces && end == END_CUT; ++k) {
    bool asks_light = k == 0u && on_targets;
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
    if (k == 0u && !on_targets) {
      // What the light sees first may be no target.
      if (surface.specular == 0.0) {
        end = END_DROPPED;
        break;
      }
      map = point.meniscus != 0u ? MAP_TARGETED : MAP_CAUSTIC;
    }
    uint dimension = DIM_FIRST_BOUNCE + BOUNCE_DIMENSIONS * k;
    if (random_unit(random, dimension) >= surface.specular) {
      // A photon that its target scatters diffusely at once has met no specular surface.
      end = k > 0u ? point.triangle : END_DROPPED;
      vec3 side = dot(point.geometric, path.direction) > 0.0 ? -point.geometric : point.geometric;
      if (k > 0u) store(slot, path.differential, beam.reach * push.shrink, point.position, side);
    } else if (k < push.specular_bounces) {
      scatter_specular(path, point, surface, random_unit(random, dimension + 1u));
    }
  }
  path.throughput.x = uintBitsToFloat(floatBitsToUint(path.throughput.x) | (map << 31u));
  ends[slot] = PhotonEnd(point.position, end, path.throughput, entered);
  atomicAdd(counters[COUNTER_RAYS], rays_traced);
}

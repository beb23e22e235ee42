#version 460
#extension GL_GOOGLE_include_directive : require
// Irradiance estimate at each pixel's visible point from the photons of one map: sum of flux K(q) / r^2 (physics: Jensen 2001, 7.2).
#include "fetch.glsl"
#include "shared/geometry.h"
#include "shared/structs.h"

layout(push_constant) uniform Push { GatherPush push; };
FETCH_TABLE(0, photons)
layout(set = 0, binding = 1, std430) readonly buffer Cells { uvec2 cells[]; };
layout(set = 0, binding = 2, std430) buffer Samples { PixelSample samples[]; };
layout(set = 0, binding = 3, std430) buffer Counters { uint counters[]; };

void main() {
  uint i = invocation_index();
  if (i >= push.pixels || samples[i].triangle >= END_FIRST) return;
  vec3 position = samples[i].position, normal = samples[i].normal;
  float radius2 = push.radius * push.radius;
  // Cells are at least two radii wide: the disc reaches into two along each axis.
  ivec3 base = grid_cell(position - push.radius, push.cell_size);
  vec3 sum = vec3(0.0);
  float found = 0.0;
  uint seen = 0u;  // candidates so far, over all cells: those of this round are [first_candidate, first_candidate + GATHER_ROUND)
  uint round_end = push.first_candidate + GATHER_ROUND;
  for (int c = 0; c < 8; ++c) {
    ivec3 cell = base + ivec3(c & 1, (c >> 1) & 1, c >> 2);
    uvec2 range = cells[cell_key(cell, push.cell_mask)];
    uint first = range.x + min(max(push.first_candidate, seen) - seen, range.y - range.x);
    uint last = range.x + min(max(round_end, seen) - seen, range.y - range.x);
    for (uint p = first; p < last; ++p) {
      uvec4 place = FETCH(photons, 2u * p);
      vec3 photon = uintBitsToFloat(place.xyz);
      vec3 to_photon = photon - position;
      float distance2 = dot(to_photon, to_photon);
      // Cells that share a key share a range: each photon counts in its own cell only. Photons of another side of the surface, or
      // beyond a corner or step, are another surface's.
      if (distance2 < radius2 && grid_cell(photon, push.cell_size) == cell && dot(unpack_direction(place.w), normal) > 0.8 &&
          abs(dot(to_photon, normal)) < 0.5 * push.radius) {
        sum += uintBitsToFloat(FETCH(photons, 2u * p + 1u).xyz) * disc_kernel(distance2 / radius2);
        found += 1.0;
      }
    }
    seen += range.y - range.x;
  }
  atomicMax(counters[COUNTER_MOST_CANDIDATES], seen);
  vec3 irradiance = sum / radius2;
  if (push.map == 0u) {
    samples[i].targeted += irradiance;
    samples[i].targeted_count += found;
  } else {
    samples[i].caustic += irradiance;
    samples[i].caustic_count += found;
  }
}

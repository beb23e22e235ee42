#version 460
#extension GL_GOOGLE_include_directive : require
// Puts stored photons beside those of their cell and writes each cell's range: cells[key] = (first, one past the last).
#include "fetch.glsl"
#include "shared/structs.h"

layout(push_constant) uniform Push { SortPush push; };
layout(set = 0, binding = 0, std430) readonly buffer Keys { uint keys[]; };
layout(set = 0, binding = 1, std430) readonly buffer Values { uint values[]; };
FETCH_TABLE(2, ends)
FETCH_TABLE(3, discs)
layout(set = 0, binding = 4, std430) writeonly buffer Sorted { uvec4 sorted[]; };  // GatheredPhoton
layout(set = 0, binding = 5, std430) writeonly buffer Cells { uvec2 cells[]; };

void main() {
  uint i = invocation_index();
  if (i >= push.count) return;
  uint key = keys[i];
  if (key == NO_CELL) return;
  uint photon = values[i];
  uvec4 flux = FETCH(ends, 2u * photon + 1u);
  sorted[3u * i] = uvec4(FETCH(ends, 2u * photon).xyz, flux.x);
  sorted[3u * i + 1u] = uvec4(FETCH(discs, 2u * photon).xyz, flux.y);
  sorted[3u * i + 2u] = uvec4(FETCH(discs, 2u * photon + 1u).xyz, flux.z);
  if (i == 0u || keys[i - 1u] != key) cells[key].x = i;
  if (i + 1u == push.count || keys[i + 1u] != key) cells[key].y = i + 1u;
}

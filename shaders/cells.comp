#version 460
#extension GL_GOOGLE_include_directive : require
// Puts stored photons beside those of their cell and writes each cell's range: cells[key] = (first, one past the last).
#include "fetch.glsl"
#include "shared/structs.h"

layout(push_constant) uniform Push { SortPush push; };
layout(set = 0, binding = 0, std430) readonly buffer Keys { uint keys[]; };
layout(set = 0, binding = 1, std430) readonly buffer Values { uint values[]; };
FETCH_TABLE(2, places)
FETCH_TABLE(3, powers)
layout(set = 0, binding = 4, std430) writeonly buffer Sorted { uvec4 sorted[]; };
layout(set = 0, binding = 5, std430) writeonly buffer Cells { uvec2 cells[]; };

void main() {
  uint i = invocation_index();
  if (i >= push.count) return;
  uint key = keys[i];
  if (key == NO_CELL) return;
  uint photon = values[i];
  sorted[2u * i] = FETCH(places, photon);
  sorted[2u * i + 1u] = FETCH(powers, photon);
  if (i == 0u || keys[i - 1u] != key) cells[key].x = i;
  if (i + 1u == push.count || keys[i + 1u] != key) cells[key].y = i + 1u;
}

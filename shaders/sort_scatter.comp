#version 460
#extension GL_GOOGLE_include_directive : require
// Moves one chunk of keys and values to their places by one digit; stable, since a chunk is walked in order.
#include "fetch.glsl"
#include "shared/structs.h"

layout(push_constant) uniform Push { SortPush push; };
layout(set = 0, binding = 0, std430) readonly buffer Keys { uint keys[]; };
layout(set = 0, binding = 1, std430) buffer Counts { uint counts[]; };
layout(set = 0, binding = 2, std430) readonly buffer Values { uint values[]; };
layout(set = 0, binding = 3, std430) writeonly buffer SortedKeys { uint sorted_keys[]; };
layout(set = 0, binding = 4, std430) writeonly buffer SortedValues { uint sorted_values[]; };

void main() {
  uint chunk = invocation_index();
  if (chunk >= push.chunks) return;
  uint end = min((chunk + 1u) * SORT_CHUNK, push.count);
  for (uint i = chunk * SORT_CHUNK; i < end; ++i) {
    uint key = keys[i];
    uint slot = ((key >> push.shift) & (SORT_BINS - 1u)) * push.chunks + chunk;
    uint place = counts[slot];
    counts[slot] = place + 1u;
    sorted_keys[place] = key;
    sorted_values[place] = push.identity != 0u ? i : values[i];
  }
}

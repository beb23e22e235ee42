#version 460
#extension GL_GOOGLE_include_directive : require
// Counts the digits of one chunk of keys; counts[bin * chunks + chunk], so that a plain scan gives each chunk its places.
#include "fetch.glsl"
#include "shared/structs.h"

layout(push_constant) uniform Push { SortPush push; };
layout(set = 0, binding = 0, std430) readonly buffer Keys { uint keys[]; };
layout(set = 0, binding = 1, std430) buffer Counts { uint counts[]; };

void main() {
  uint chunk = invocation_index();
  if (chunk >= push.chunks) return;
  for (uint bin = 0u; bin < SORT_BINS; ++bin) counts[bin * push.chunks + chunk] = 0u;
  uint end = min((chunk + 1u) * SORT_CHUNK, push.count);
  for (uint i = chunk * SORT_CHUNK; i < end; ++i) {
    uint bin = (keys[i] >> push.shift) & (SORT_BINS - 1u);
    counts[bin * push.chunks + chunk] += 1u;
  }
}

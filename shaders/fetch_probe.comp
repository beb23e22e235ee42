#version 460
#extension GL_GOOGLE_include_directive : require
// Reads a table at places that depend on what was read before, as the search of a hierarchy does: for timing alone.
#include "fetch.glsl"
#include "shared/structs.h"

FETCH_TABLE(0, Probe)
layout(set = 0, binding = 1, std430) writeonly buffer Sums { uint sums[]; };
layout(push_constant) uniform Push { ProbePush push; };

const uint STEPS = 64u;

void main() {
  uint i = invocation_index();
  if (i >= push.count) return;
  uint at = i, sum = 0u;
  for (uint step = 0u; step < STEPS; ++step) {
    uvec4 element = FETCH(Probe, at & push.mask);
    sum += element.x ^ element.w;
    at = (at * 1664525u + element.y) >> 3;
  }
  sums[i] = sum;
}

#version 460
#extension GL_GOOGLE_include_directive : require
// One level of an exclusive scan: each invocation turns a block of SCAN_BLOCK values into its running sums and leaves the total.
// With ADD_TOTALS the way back: adds the scanned totals of the blocks before.
#include "fetch.glsl"
#include "shared/structs.h"

layout(constant_id = 0) const bool ADD_TOTALS = false;
layout(push_constant) uniform Push { ScanPush push; };
layout(set = 0, binding = 0, std430) buffer Values { uint values[]; };

void main() {
  uint block = invocation_index();
  if (block * SCAN_BLOCK >= push.count) return;
  uint end = push.first + min((block + 1u) * SCAN_BLOCK, push.count);
  uint sum = ADD_TOTALS ? values[push.totals + block] : 0u;
  for (uint i = push.first + block * SCAN_BLOCK; i < end; ++i) {
    uint value = values[i];
    values[i] = ADD_TOTALS ? value + sum : sum;
    if (!ADD_TOTALS) sum += value;
  }
  if (!ADD_TOTALS) values[push.totals + block] = sum;
}

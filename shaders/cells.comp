#version 460
#extension GL_GOOGLE_include_directive : require
// The hash grid of one map: photons beside those of their cell, and each cell's range. A stable radix sort by digits of SORT_BITS, then
// one collecting step. One shader for all steps: a driver that compiles at the first dispatch (lavapipe) charges every shader anew.
#include "fetch.glsl"
#include "shared/structs.h"

layout(push_constant) uniform Push { CellsPush push; };
layout(set = 0, binding = 0, std430) readonly buffer Keys { uint keys[]; };
FETCH_TABLE(1, ends)
FETCH_TABLE(2, discs)
layout(set = 0, binding = 3, std430) buffer Pairs { uvec2 pairs[]; };  // (key, photon)
layout(set = 0, binding = 4, std430) buffer Counts { uint counts[]; };
layout(set = 0, binding = 5, std430) writeonly buffer Sorted { uvec4 sorted[]; };  // GatheredPhoton
layout(set = 0, binding = 6, std430) writeonly buffer Cells { uvec2 cells[]; };    // (first, one past the last)

// Walks one chunk of SORT_CHUNK elements in order, hence stable. CELLS_COUNT counts its digits, at counts[bin * chunks + chunk]: a plain
// scan turns these into places, to which CELLS_MOVE moves the elements.
void walk(uint chunk) {
  uint end = min((chunk + 1u) * SORT_CHUNK, push.count);
  for (uint i = chunk * SORT_CHUNK; i < end; ++i) {
    uvec2 pair = push.shift == 0u ? uvec2(keys[i], i) : pairs[push.from + i];
    uint slot = ((pair.x >> push.shift) & (SORT_BINS - 1u)) * push.chunks + chunk;
    uint place = counts[slot];
    counts[slot] = place + 1u;
    if (push.step == CELLS_MOVE) pairs[push.to + place] = pair;
  }
}

// One level of an exclusive scan of counts[from .. from + count). CELLS_SCAN turns a block of SCAN_BLOCK values into its running sums and
// leaves the total at counts[to + block]; CELLS_ADD, the way back, adds the scanned totals.
void scan(uint block) {
  bool adds = push.step == CELLS_ADD;
  uint end = min((block + 1u) * SCAN_BLOCK, push.count);
  uint sum = adds ? counts[push.to + block] : 0u;
  for (uint i = block * SCAN_BLOCK; i < end; ++i) {
    uint value = counts[push.from + i];
    counts[push.from + i] = adds ? sum + value : sum;
    if (!adds) sum += value;
  }
  if (!adds && block * SCAN_BLOCK < push.count) counts[push.to + block] = sum;
}

void collect(uint i) {
  if (i >= push.count) return;
  uvec2 pair = pairs[push.from + i];
  if (pair.x == NO_CELL) return;
  uvec4 flux = FETCH(ends, 2u * pair.y + 1u);
  sorted[3u * i] = uvec4(FETCH(ends, 2u * pair.y).xyz, flux.x);
  sorted[3u * i + 1u] = uvec4(FETCH(discs, 2u * pair.y).xyz, flux.y);
  sorted[3u * i + 2u] = uvec4(FETCH(discs, 2u * pair.y + 1u).xyz, flux.z);
  uint next = i + 1u < push.count ? pairs[push.from + i + 1u].x : NO_CELL;
  if (next == pair.x) return;
  // The first cell's range begins at 0, as the table was cleared to.
  cells[pair.x].y = i + 1u;
  if (next != NO_CELL) cells[next].x = i + 1u;
}

void main() {
  uint index = invocation_index();
  if (push.step <= CELLS_MOVE) walk(index);
  else if (push.step <= CELLS_ADD) scan(index);
  else collect(index);
}

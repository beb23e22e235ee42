#version 460
#extension GL_GOOGLE_include_directive : require
// The hash grid of the photon maps: each photon is entered in every cell that its disc reaches into, and entries are put beside those of their
// cell by a stable radix sort by digits of SORT_BITS. One shader for all steps: a driver that compiles at the first dispatch (lavapipe)
// charges every shader anew.
#include "fetch.glsl"
#include "shared/geometry.h"
#include "shared/structs.h"

layout(push_constant) uniform Push { CellsPush push; };
FETCH_TABLE(0, discs)
layout(set = 0, binding = 1, std430) writeonly buffer Entries { uvec2 entries[]; };  // (key, photon)
layout(set = 0, binding = 2, std430) buffer Counts { uint counts[]; };
layout(set = 0, binding = 3, std430) writeonly buffer Listed { uint listed[]; };  // photons
layout(set = 0, binding = 4, std430) writeonly buffer Cells { uvec2 cells[]; };   // (first, one past the last) of listed, by key
FETCH_PAIRS(5, entries)                                                           // the same as 1

// CELLS_NUMBER counts the cells of a photon, at counts[i]: a scan turns these into places, at which CELLS_ENTER enters it.
void enter(uint i) {
  if (i >= push.count) return;
  uint photon = push.from + i, number = 0u;
  vec3 position = uintBitsToFloat(FETCH(discs, 3u * photon).xyz), alpha = uintBitsToFloat(FETCH(discs, 3u * photon + 1u).xyz);
  vec3 beta = uintBitsToFloat(FETCH(discs, 3u * photon + 2u).xyz), facing = cross(alpha, beta);
  uint level = disc_level(alpha, beta, push.narrowest, push.levels);
  float size = level_cell_size(push.narrowest, level);
  vec3 extent = disc_extent(alpha, beta), reach = cell_reach(alpha, beta, size);
  ivec3 low = grid_cell(position - extent, size), high = grid_cell(position + extent, size);
  if (alpha == vec3(0.0)) low = ivec3(0), high = ivec3(-1);
  bool enters = push.step == CELLS_ENTER;
  uint place = push.to + (enters ? counts[i] : 0u);
  ivec3 cell = low;
  while (cell.z <= high.z) {
    if (disc_meets_cell(size * vec3(cell) - position, alpha, beta, facing, reach)) {
      if (enters) entries[place + number] = uvec2(cell_key(cell, level, push.cell_mask), photon);
      number += 1u;
    }
    cell.x += 1;
    if (cell.x > high.x) {
      cell.x = low.x;
      cell.y += 1;
    }
    if (cell.y > high.y) {
      cell.y = low.y;
      cell.z += 1;
    }
  }
  if (!enters) counts[i] = number;
}

// Walks one chunk of SORT_CHUNK elements in order, hence stable. CELLS_COUNT counts its digits, at counts[bin * chunks + chunk]: a plain
// scan turns these into places, to which CELLS_MOVE moves the elements.
void walk(uint chunk) {
  uint end = min((chunk + 1u) * SORT_CHUNK, push.count);
  for (uint i = chunk * SORT_CHUNK; i < end; ++i) {
    uvec2 entry = FETCH_PAIR(entries, push.from + i);
    uint slot = ((entry.x >> push.shift) & (SORT_BINS - 1u)) * push.chunks + chunk;
    uint place = counts[slot];
    counts[slot] = place + 1u;
    if (push.step == CELLS_MOVE) entries[push.to + place] = entry;
  }
}

// One level of an exclusive scan of counts[from .. from + count). CELLS_SCAN turns a block of SCAN_BLOCK values into its running sums and
// leaves the total at counts[to + block]; CELLS_ADD, the way back, adds the scanned totals.
void scan(uint block) {
  bool adds = push.step == CELLS_ADD;
  uint end = min((block + 1u) * SCAN_BLOCK, push.count);
  if (block * SCAN_BLOCK >= push.count) return;
  uint sum = adds ? counts[push.to + block] : 0u;
  for (uint i = block * SCAN_BLOCK; i < end; ++i) {
    uint value = counts[push.from + i];
    counts[push.from + i] = adds ? sum + value : sum;
    if (!adds) sum += value;
  }
  if (!adds) counts[push.to + block] = sum;
}

// Where two cells of a photon have one key, its entries stand side by side: the sort is stable.
void collect(uint i) {
  if (i >= push.count) return;
  uvec2 entry = FETCH_PAIR(entries, push.from + i);
  uvec2 before = i > 0u ? FETCH_PAIR(entries, push.from + i - 1u) : uvec2(0u, LISTED_TWICE);
  listed[i] = entry.y | (entry == before ? LISTED_TWICE : 0u);
  // The first cell's range begins at 0, as the table was cleared to.
  if (i > 0u && before.x != entry.x) {
    cells[before.x].y = i;
    cells[entry.x].x = i;
  }
  if (i + 1u == push.count) cells[entry.x].y = push.count;
}

void main() {
  uint index = invocation_index();
  if (push.step <= CELLS_ENTER) enter(index);
  else if (push.step <= CELLS_MOVE) walk(index);
  else if (push.step <= CELLS_ADD) scan(index);
  else collect(index);
}

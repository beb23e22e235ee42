// The hash grid's cells and the density kernel.
#ifndef MENISCAL_GEOMETRY_H
#define MENISCAL_GEOMETRY_H
#include "dialect.h"

SHARED_BEGIN

SHARED ivec3 grid_cell(vec3 position, float cell_size) { return ivec3(floor(position / cell_size)); }

// Cells of a level are two of its discs' half-widths wide: a disc reaches into two along each axis.
SHARED float level_cell_size(float narrowest, uint level) { return 2.0001f * narrowest * float(1u << level); }

// Teschner et al., "Optimized Spatial Hashing for Collision Detection of Deformable Objects", 2003, mixed once more.
SHARED uint cell_key(ivec3 cell, uint level, uint mask) {
  uint h = uint(cell.x) * 73856093u ^ uint(cell.y) * 19349663u ^ uint(cell.z) * 83492791u;
  h ^= h >> 15u;
  h *= 0x2C1B3C6Du;
  return level * (mask + 1u) + ((h ^ (h >> 13u)) & mask);
}

// Density kernel over the unit disc, q2 = squared distance in units of the radius, in [0, 1]: 3/pi (1 - q2)^2,
// integrates to 1.
SHARED float disc_kernel(float q2) {
  float s = 1.0f - q2;
  return 0.954929658551372f * s * s;
}

SHARED_END
#endif

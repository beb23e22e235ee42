// Small geometry that both sides need bit for bit alike in meaning: packed directions and grid cells.
#ifndef MENISCAL_GEOMETRY_H
#define MENISCAL_GEOMETRY_H
#include "dialect.h"

SHARED_BEGIN

// A unit vector in 32 bits, octahedral: Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors", JCGT 2014.
SHARED uint pack_direction(vec3 n) {
  float l1 = abs(n.x) + abs(n.y) + abs(n.z);
  vec2 p = vec2(n.x, n.y) / l1;
  if (n.z < 0.0f) {
    p = vec2((1.0f - abs(p.y)) * (p.x >= 0.0f ? 1.0f : -1.0f), (1.0f - abs(p.x)) * (p.y >= 0.0f ? 1.0f : -1.0f));
  }
  return packSnorm2x16(p);
}
SHARED vec3 unpack_direction(uint bits) {
  vec2 p = unpackSnorm2x16(bits);
  vec3 n = vec3(p.x, p.y, 1.0f - abs(p.x) - abs(p.y));
  float t = max(-n.z, 0.0f);
  n.x += n.x >= 0.0f ? -t : t;
  n.y += n.y >= 0.0f ? -t : t;
  return normalize(n);
}

SHARED ivec3 grid_cell(vec3 position, float cell_size) { return ivec3(floor(position / cell_size)); }

// Teschner et al., "Optimized Spatial Hashing for Collision Detection of Deformable Objects", 2003, mixed once more.
SHARED uint cell_key(ivec3 cell, uint mask) {
  uint h = uint(cell.x) * 73856093u ^ uint(cell.y) * 19349663u ^ uint(cell.z) * 83492791u;
  h ^= h >> 15u;
  h *= 0x2C1B3C6Du;
  return (h ^ (h >> 13u)) & mask;
}

// Density kernel over the unit disc, q2 = (distance / radius)^2 in [0, 1]: 3/pi (1 - q2)^2, integrates to 1.
SHARED float disc_kernel(float q2) {
  float s = 1.0f - q2;
  return 0.954929658551372f * s * s;
}

SHARED_END
#endif

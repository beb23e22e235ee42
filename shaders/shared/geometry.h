// The discs of photons, and the hash grid's cells that they reach into.
#ifndef MENISCAL_GEOMETRY_H
#define MENISCAL_GEOMETRY_H
#include "dialect.h"
#include "structs.h"

SHARED_BEGIN

// Cells lie round multiples of their size, so that surfaces through the origin are not on their borders.
SHARED ivec3 grid_cell(vec3 position, float cell_size) { return ivec3(floor(position / cell_size + 0.5f)); }

// Cells of level 0; each further level's are twice as wide. Larger ones hold more that a pixel tests in vain, smaller
// ones make more entries: measured.
SHARED float level_cell_size(float narrowest, uint level) { return 1.45f * narrowest * float(1u << level); }

// The level at which a disc is entered: the first, i, where the geometric mean of its half-widths is at most 2^i times
// `narrowest`.
SHARED uint disc_level(vec3 alpha, vec3 beta, float narrowest, uint levels) {
  float least2 = narrowest * narrowest, part = 1.0001f * (dot(alpha, alpha) * least2) * (dot(beta, beta) * least2);
  uint level = 0u;
  while (level + 1u < levels && part < 1.0f) {
    part *= 16.0f;
    level += 1u;
  }
  return level;
}

// Half the disc's thickness in units of its wide half-width: on a round surface, what lies within the disc and faces
// within 37 degrees as it does is no further from its plane than tan(37 / 2).
const float DISC_THICKNESS = 1.0f / 3.0f;
const float DISC_FACING = 0.8f;  // cosine of that angle

// Whether a point at `offset` from the photon lies in its disc: q2 < 1, and its normal and place are those of the same
// surface. `facing`: alpha x beta.
SHARED bool disc_holds(vec3 offset, vec3 normal, float q2, vec3 beta, vec3 facing, float density) {
  float height = dot(offset, facing);
  return q2 < 1.0f && dot(facing, normal) > DISC_FACING * density &&
         height * height < DISC_THICKNESS * DISC_THICKNESS * dot(beta, beta);
}

// Half-extents along the axes of the disc with its thickness.
SHARED vec3 disc_extent(vec3 alpha, vec3 beta) {
  float wide2 = 1.0f / dot(alpha, alpha), narrow2 = 1.0f / dot(beta, beta);
  vec3 a = wide2 * alpha, b = narrow2 * beta;
  return sqrt(a * a + b * b) + DISC_THICKNESS * wide2 * sqrt(narrow2) * abs(cross(alpha, beta));
}

// How far a cell reaches from its centre along alpha, beta and alpha x beta, in the units of these; the last includes
// the disc's thickness.
SHARED vec3 cell_reach(vec3 alpha, vec3 beta, float cell_size) {
  vec3 a = abs(alpha), b = abs(beta), n = abs(cross(alpha, beta));
  return 0.5f * cell_size * vec3(a.x + a.y + a.z, b.x + b.y + b.z, n.x + n.y + n.z) +
         vec3(0.0f, 0.0f, DISC_THICKNESS * sqrt(dot(beta, beta)));
}

// False where no point of a cell, whose centre is at `offset` from the photon, lies in its disc.
SHARED bool disc_meets_cell(vec3 offset, vec3 alpha, vec3 beta, vec3 facing, vec3 reach) {
  float a = max(abs(dot(alpha, offset)) - reach.x, 0.0f), b = max(abs(dot(beta, offset)) - reach.y, 0.0f);
  return a * a + b * b < 1.0f && abs(dot(facing, offset)) < reach.z;
}

// Teschner et al., "Optimized Spatial Hashing for Collision Detection of Deformable Objects", 2003, mixed once more.
SHARED uint cell_key(ivec3 cell, uint level, uint mask) {
  uint h = uint(cell.x) * 73856093u ^ uint(cell.y) * 19349663u ^ uint(cell.z) * 83492791u;
  h ^= h >> 15u;
  h *= 0x2C1B3C6Du;
  return level * (mask + 1u) + ((h ^ (h >> 13u)) & mask);
}

// A unit vector on the octahedron, 16 bits a coordinate: to 5e-5.
SHARED uint pack_direction(vec3 d) {
  vec2 p = vec2(d.x, d.y) / (abs(d.x) + abs(d.y) + abs(d.z));
  vec2 folded = vec2((1.0f - abs(p.y)) * (p.x < 0.0f ? -1.0f : 1.0f), (1.0f - abs(p.x)) * (p.y < 0.0f ? -1.0f : 1.0f));
  vec2 q = (d.z < 0.0f ? folded : p) * 32767.0f + 32767.5f;
  return uint(q.x) | uint(q.y) << 16u;
}
SHARED vec3 unpack_direction(uint bits) {
  vec2 q = (vec2(float(bits & 0xFFFFu), float(bits >> 16u)) - 32767.0f) / 32767.0f;
  float z = 1.0f - abs(q.x) - abs(q.y), fold = max(-z, 0.0f);
  return normalize(vec3(q.x + (q.x < 0.0f ? fold : -fold), q.y + (q.y < 0.0f ? fold : -fold), z));
}

// Density kernel on a disc, by the power of its slope; q2 = squared distance in units of the half-widths, in [0, 1]. Integrates to 1. The
// biweight one, 3/pi (1 - q2)^2, reaches the disc's border; the flatter ones end before, so that all have the same second moment: they
// blur alike, and differ in how well they even out noise.
SHARED float disc_kernel(uint kernel, float q2) {
  if (kernel == KERNEL_BIWEIGHT) {
    float s = 1.0f - q2;
    return 0.954929658551372f * s * s;
  }
  if (kernel == KERNEL_EPANECHNIKOV) return 0.848826363156775f * max(1.0f - q2 / 0.75f, 0.0f);
  return q2 < 0.5f ? 0.636619772367581f : 0.0f;
}

SHARED_END
#endif

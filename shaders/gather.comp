#version 460
#extension GL_GOOGLE_include_directive : require
// Irradiance at each pixel's visible point from the photons of the targeted and the caustic map, or of the global one: sum of flux K(q2) /
// (product of the disc's half-widths), over the discs that hold the point. Where an outer face reflects, what it reflects beyond Lambert's.
#include "fetch.glsl"
#include "reflection.glsl"
#include "shared/geometry.h"
#include "shared/structs.h"

layout(push_constant) uniform Push { GatherPush push; };
FETCH_TABLE(0, discs)
FETCH_PAIRS(1, cells)
layout(set = 0, binding = 2, std430) writeonly buffer Samples { PixelSample samples[]; };
layout(set = 0, binding = 3, std430) buffer Counters { uint counters[]; };
FETCH_WORDS(4, listed)
layout(constant_id = 0) const bool GLOBAL = false;  // the photons are the global map's
layout(constant_id = 1) const bool GLOSSY = false;  // some outer face reflects
layout(constant_id = 2) const uint KERNEL = KERNEL_BIWEIGHT;
FETCH_TABLE(5, samples)  // the same as 2: loads from storage buffers are dear on lavapipe

FETCH_WORDS(6, arrivals)
FETCH_TABLE(7, gloss)  // the same as 8
layout(set = 0, binding = 8, std430) writeonly buffer Gloss { PixelGloss glosses[]; };

// Texels of a PixelGloss, and of what is added to.
const uint GLOSS_TEXELS = 8u, GLOSS_TARGETED = 5u, GLOSS_CAUSTIC = 6u, GLOSS_GLOBAL = 7u;

Face fetch_face(uint texel) {
  uvec4 a = FETCH(gloss, texel), b = FETCH(gloss, texel + 1u), c = FETCH(gloss, texel + 2u);
  return Face(uintBitsToFloat(a.xyz), uintBitsToFloat(b.xyz), uintBitsToFloat(a.w), uintBitsToFloat(c.xyz), uintBitsToFloat(b.w));
}

// Texels of a PixelSample, and of what is read of it.
const uint SAMPLE_TEXELS = 9u, POSITION = 0u, NORMAL = 1u, ALBEDO_TRIANGLE = 2u, EMITTED_LIT = 4u, TARGETED = 6u, CAUSTIC = 7u, OF_GLOBAL = 8u;

// Pixels that run together lie in blocks of 8 x 8, and in those in blocks of 4 x 2: they read the same cells.
uint pixel_of(uint invocation) {
  uint block = invocation / 64u, place = invocation % 64u, blocks = (push.width + 7u) / 8u;
  uint x = 8u * (block % blocks) + (place & 3u) + ((place >> 1u) & 4u);
  uint y = 8u * (block / blocks) + ((place >> 2u) & 1u) + ((place >> 3u) & 6u);
  return x < push.width ? y * push.width + x : push.pixels;
}

void main() {
  uint invocation = invocation_index();
  uint i = pixel_of(push.first + invocation), texel = SAMPLE_TEXELS * i;
  if (invocation >= push.count || i >= push.pixels || FETCH(samples, texel + ALBEDO_TRIANGLE).w >= END_FIRST ||
      FETCH(samples, texel + EMITTED_LIT).w != 0u)
    return;
  vec3 position = uintBitsToFloat(FETCH(samples, texel + POSITION).xyz);
  vec3 normal = uintBitsToFloat(FETCH(samples, texel + NORMAL).xyz);
  vec4 targeted = GLOBAL ? vec4(0.0) : uintBitsToFloat(FETCH(samples, texel + TARGETED));
  vec4 other = uintBitsToFloat(FETCH(samples, texel + (GLOBAL ? OF_GLOBAL : CAUSTIC)));
  uint gloss_texel = GLOSS_TEXELS * i;
  Face face;
  vec3 albedo, beyond, beyond_targeted, throughput;  // what the face adds, in all and of the targeted map
  bool reflects = false;
  if (GLOSSY) {
    uvec4 rest = FETCH(gloss, gloss_texel + 3u);
    reflects = rest.w != 0u;
    throughput = uintBitsToFloat(rest.xyz);
    face = fetch_face(gloss_texel);
    albedo = uintBitsToFloat(FETCH(samples, texel + ALBEDO_TRIANGLE).xyz);
    beyond = uintBitsToFloat(FETCH(gloss, gloss_texel + (GLOBAL ? GLOSS_GLOBAL : GLOSS_CAUSTIC)).xyz);
    beyond_targeted = uintBitsToFloat(FETCH(gloss, gloss_texel + GLOSS_TARGETED).xyz);
  }
  uint seen = 0u;  // candidates so far, over all cells: those of this round are [first_candidate, first_candidate + GATHER_ROUND)
  uint round_end = push.first_candidate + GATHER_ROUND;
  for (uint level = 0u; level < push.levels; ++level) {
    ivec3 cell = grid_cell(position, level_cell_size(push.narrowest, level));
    uvec2 range = FETCH_PAIR(cells, cell_key(cell, level, push.cell_mask));
    uint first = range.x + min(max(push.first_candidate, seen) - seen, range.y - range.x);
    uint last = range.x + min(max(round_end, seen) - seen, range.y - range.x);
    for (uint p = first; p < last; ++p) {
      uint photon = FETCH_WORD(listed, p), texel = 3u * (photon & ~LISTED_TWICE);
      uvec4 place = FETCH(discs, texel), along = FETCH(discs, texel + 1u), across = FETCH(discs, texel + 2u);
      vec3 offset = position - uintBitsToFloat(place.xyz), alpha = uintBitsToFloat(along.xyz), beta = uintBitsToFloat(across.xyz);
      vec3 facing = cross(alpha, beta);
      float a = dot(alpha, offset), b = dot(beta, offset), q2 = a * a + b * b, density = length(facing);
      // Cells that share a key share a range: what is not of this cell does not hold the point.
      if (disc_holds(offset, normal, q2, beta, facing, density) && photon < LISTED_TWICE) {
        vec3 flux = uintBitsToFloat(uvec3(place.w & 0x7FFFFFFFu, along.w, across.w));
        vec4 found = vec4(flux * (disc_kernel(KERNEL, q2) * density), 1.0);
        if (!GLOBAL && (place.w >> 31u) == MAP_TARGETED) targeted += found;
        else other += found;
        if (GLOSSY && reflects) {
          vec3 incoming = -unpack_direction(FETCH_WORD(arrivals, photon));
          vec3 more = throughput * found.xyz * beyond_lambert(face, albedo, incoming, push.lobe_part);
          if (!GLOBAL && (place.w >> 31u) == MAP_TARGETED) beyond_targeted += more;
          else beyond += more;
        }
      }
    }
    seen += range.y - range.x;
  }
  atomicMax(counters[COUNTER_MOST_CANDIDATES], seen);
  if (GLOSSY && GLOBAL) glosses[i].global = beyond;
  if (GLOSSY && !GLOBAL) {
    glosses[i].targeted = beyond_targeted;
    glosses[i].caustic = beyond;
  }
  if (GLOBAL) {
    samples[i].global = other.xyz;
    samples[i].global_count = other.w;
    return;
  }
  samples[i].targeted = targeted.xyz;
  samples[i].targeted_count = targeted.w;
  samples[i].caustic = other.xyz;
  samples[i].caustic_count = other.w;
}

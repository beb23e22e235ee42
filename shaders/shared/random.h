// Counter-based random numbers: a number depends on (seed, pass, index, dimension) and on nothing else, so the GPU and
// the reference path draw the same ones, in any order. All uniform numbers are half-open, [0, 1).
#ifndef MENISCAL_RANDOM_H
#define MENISCAL_RANDOM_H
#include "dialect.h"

SHARED_BEGIN

// Dimensions of a photon's or camera path's number sequence. Paths take BOUNCE_DIMENSIONS numbers a bounce from
// FIRST_BOUNCE on.
const uint DIM_LIGHT = 2u, DIM_LIGHT_U = 3u, DIM_LIGHT_V = 4u, DIM_LIGHT_SIDE = 5u, DIM_FIRST_BOUNCE = 8u;
const uint BOUNCE_DIMENSIONS = 2u;  // 0: specular or diffuse, 1: reflect or refract
// At diffuse surfaces: 0: store or scatter, 1 and 2: direction, 3: by which lobe.
const uint DIM_FIRST_SCATTERING = 0x10000u, SCATTERING_DIMENSIONS = 4u;
// At rough specular ones, beside those of the bounce: 0 and 1: microfacet.
const uint DIM_FIRST_FACET = 0x20000u;
// What the numbers are drawn for: keeps photons of each beam and camera paths apart.
const uint STREAM_BEAM = 1u;             // of the i-th beam: STREAM_BEAM + i
const uint STREAM_GLOBAL = 0x40000000u;  // the same for the global map
const uint STREAM_CAMERA = 0x80000000u;  // of the i-th sample of a pixel and pass: STREAM_CAMERA + i
const uint STREAM_HIGHLIGHTS = 0xC0000000u;  // of a pixel; its i-th cell takes the dimensions 2 i and 2 i + 1

// Jarzynski and Olano, "Hash Functions for GPU Rendering", JCGT 2020: pcg4d.
SHARED uvec4 pcg4d(uvec4 v) {
  v = v * 1664525u + 1013904223u;
  v.x += v.y * v.w;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v.w += v.y * v.z;
  v = v ^ (v >> 16u);
  v.x += v.y * v.w;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v.w += v.y * v.z;
  return v;
}

// The 24 leading bits as a float in [0, 1).
SHARED float unit_float(uint bits) { return float(bits >> 8u) * 5.9604644775390625e-8f; }

// One sequence: of one photon or one pixel in one pass.
struct RandomKey {
  uint seed, pass, stream, index;
};

SHARED uint random_bits(RandomKey key, uint dimension) {
  return pcg4d(uvec4(key.index, key.pass, key.seed ^ (key.stream * 0x9E3779B9u), dimension)).x;
}
SHARED float random_unit(RandomKey key, uint dimension) { return unit_float(random_bits(key, dimension)); }

// Where in a pixel its i-th sample in a pass lies, in [0, 1)^2: the R2 sequence (Roberts 2018), shifted at random. `key`: of the pixel's
// sample 0.
SHARED vec2 pixel_place(RandomKey key, uint i) {
  return vec2(unit_float(random_bits(key, 0u) + 3242174889u * i), unit_float(random_bits(key, 1u) + 2447445414u * i));
}

// A surface that the camera sees asks all lights, or so many, each of so many candidates picked by power, in proportion to what these would
// give it.
const uint LIGHTS_ASKED = 4u, LIGHT_CANDIDATES = 8u;

// Numbers that choose, for a camera path, a light and a point on it: the i-th of LIGHTS_ASKED. Those of a pixel's samples in a pass are
// spread evenly, too: each by the multiples of an irrational number, shifted at random (the golden ratio; the R3 sequence, Roberts 2018).
SHARED uint light_bits(RandomKey key, uint dimension, uint i) {
  uint step = dimension == DIM_LIGHT ? 2654435769u : dimension == DIM_LIGHT_SIDE ? 3518319155u : dimension == DIM_LIGHT_U ? 2882110344u : 2360945575u;
  uint index = LIGHTS_ASKED * (key.stream - STREAM_CAMERA) + i;
  key.stream = STREAM_CAMERA;
  return random_bits(key, dimension) + step * index;
}

SHARED uint reverse_bits(uint x) {
  x = (x << 16u) | (x >> 16u);
  x = ((x & 0x00FF00FFu) << 8u) | ((x & 0xFF00FF00u) >> 8u);
  x = ((x & 0x0F0F0F0Fu) << 4u) | ((x & 0xF0F0F0F0u) >> 4u);
  x = ((x & 0x33333333u) << 2u) | ((x & 0xCCCCCCCCu) >> 2u);
  return ((x & 0x55555555u) << 1u) | ((x & 0xAAAAAAAAu) >> 1u);
}

// Nested uniform (Owen) scrambling of a base-2 number by hashing its reversed bits: Laine and Karras 2011.
SHARED uint owen_scramble(uint x, uint seed) {
  x = reverse_bits(x);
  x += seed;
  x ^= x * 0x6C50B47Cu;
  x ^= x * 0xB82F1E52u;
  x ^= x * 0xC7AFE638u;
  x ^= x * 0x8D22F6E6u;
  return reverse_bits(x);
}

// The index-th point of the first two Sobol dimensions.
SHARED uvec2 sobol_index_point(uint index) {
  uint y = 0u, v = 0x80000000u;
  for (uint i = index; i != 0u; i >>= 1u) {
    if ((i & 1u) != 0u) y ^= v;
    v ^= v >> 1u;
  }
  return uvec2(reverse_bits(index), y);
}

// The index-th point of the first two Sobol dimensions, Owen-scrambled: stratified in the square over any 2^k
// consecutive indices, each point alone uniform. `key.index` is the point; the scrambling depends on the rest of the
// key, so passes are independent.
SHARED uvec2 sobol_point(RandomKey key) {
  uvec2 point = sobol_index_point(key.index);
  uvec4 scramble = pcg4d(uvec4(key.pass, key.seed, key.stream, 0x5CA4B1Eu));
  return uvec2(owen_scramble(point.x, scramble.x), owen_scramble(point.y, scramble.y));
}

// The same point's third and fourth dimensions (Joe and Kuo, "Constructing Sobol Sequences with Better Two-Dimensional
// Projections", 2008): direction numbers by the recurrences of x^2 + x + 1 from 1, 3 and of x^3 + x + 1 from 1, 3, 1.
SHARED uvec2 sobol_point_beyond(RandomKey key) {
  uint z = 0u, w = 0u;
  uint z0 = 0x80000000u, z1 = 0xC0000000u;
  uint w0 = 0x80000000u, w1 = 0xC0000000u, w2 = 0x20000000u;
  for (uint i = key.index; i != 0u; i >>= 1u) {
    if ((i & 1u) != 0u) {
      z ^= z0;
      w ^= w0;
    }
    uint z2 = z1 ^ z0 ^ (z0 >> 2u), w3 = w1 ^ w0 ^ (w0 >> 3u);
    z0 = z1;
    z1 = z2;
    w0 = w1;
    w1 = w2;
    w2 = w3;
  }
  uvec4 scramble = pcg4d(uvec4(key.pass, key.seed, key.stream, 0x5CA4B1Eu));
  return uvec2(owen_scramble(z, scramble.z), owen_scramble(w, scramble.w));
}

SHARED_END
#endif

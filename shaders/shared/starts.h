// Where in the square of starts photons of a beam start, and with what weight.
#ifndef MENISCAL_STARTS_H
#define MENISCAL_STARTS_H
#include "random.h"

SHARED_BEGIN

// bits x extent / 2^16, for extent up to 2^16: no rounding, so that CPU and GPU start at the same place.
SHARED uint scale_bits(uint bits, uint extent) { return (bits >> 16u) * extent + (((bits & 0xFFFFu) * extent) >> 16u); }

// The place of a photon's start in the square, in units of 2^-32.
SHARED uvec2 start_bits(RandomKey key, uvec2 start, uvec2 extent) {
  uvec2 point = sobol_point(key);
  return uvec2((start.x << 16u) + scale_bits(point.x, extent.x), (start.y << 16u) + scale_bits(point.y, extent.y));
}

// XOR of the columns whose bits are set, of the first `count`.
SHARED uint xor_columns(uint bits, uvec4 columns, uint count) {
  uint x = (bits & 1u) != 0u ? columns.x : 0u;
  if (count > 1u && (bits & 2u) != 0u) x ^= columns.y;
  if (count > 2u && (bits & 4u) != 0u) x ^= columns.z;
  if (count > 3u && (bits & 8u) != 0u) x ^= columns.w;
  return x;
}

// A photon of the global map is kept at one of the diffuse surfaces that it meets after the first: the probability of
// keeping it at one with this albedo, so that what it carries changes little from one to the next.
SHARED float storing_probability(vec3 albedo) {
  return clamp(1.0f - (albedo.x + albedo.y + albedo.z) / 3.0f, 0.2f, 1.0f);
}

// Rises from 0 to 1 over [0, 1], smoothly: discs that differ across a border lose and gain light by its curvature only.
SHARED float fade_in(float t) {
  float s = clamp(t, 0.0f, 1.0f);
  return s * s * (3.0f - 2.0f * s);
}

// 1 within the window, 0 outside, fading over its border.
SHARED float window_weight(vec2 place, vec4 window, vec2 fade) {
  return fade_in((place.x - window.x) / fade.x) * fade_in((window.z - place.x) / fade.x) *
         fade_in((place.y - window.y) / fade.y) * fade_in((window.w - place.y) / fade.y);
}

SHARED_END
#endif

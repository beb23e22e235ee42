// The table of beams: what photons start in.
#include "emission.glsl"
#include "shared/starts.h"

FETCH_TABLE(BIND_BEAMS, beams)

const uint BEAM_TEXELS = 14u;

Beam fetch_beam(uint i) {
  uint t = BEAM_TEXELS * i;
  Beam b;
  uvec4 a = FETCH(beams, t), u = FETCH(beams, t + 1u), v = FETCH(beams, t + 2u), window = FETCH(beams, t + 3u);
  uvec4 own = FETCH(beams, t + 4u), finer = FETCH(beams, t + 5u), fade = FETCH(beams, t + 6u);
  uvec4 start = FETCH(beams, t + 7u), rest = FETCH(beams, t + 8u);
  b.corner = uintBitsToFloat(a.xyz), b.first = a.w;
  b.u = uintBitsToFloat(u.xyz), b.count = u.w;
  b.v = uintBitsToFloat(v.xyz), b.kind = v.w;
  b.start = window.xy, b.extent = window.zw;
  b.own = uintBitsToFloat(own), b.finer = uintBitsToFloat(finer);
  b.own_fade = uintBitsToFloat(fade.xy), b.finer_fade = uintBitsToFloat(fade.zw);
  b.map = start.x, b.light = start.y, b.light_first = start.z, b.target_first = start.w;
  b.target_count = rest.x, b.power = uintBitsToFloat(rest.y), b.reach = uintBitsToFloat(rest.z), b.order_bits = rest.w;
  return b;
}

// Which of the beam's starts its i-th photon takes: see Beam.
uint start_index(uint beam, uint i, uint count, uint bits) {
  if (i >> bits >= count >> bits) return i;
  uint index = i >> bits << bits;
  for (uint c = 0u; 4u * c < bits; ++c) index ^= xor_columns(i >> (4u * c), FETCH(beams, BEAM_TEXELS * beam + 9u + c), bits - 4u * c);
  return index;
}

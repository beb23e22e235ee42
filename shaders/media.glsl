// Dielectrics that lie in each other: which of those that a path is inside of it is in optically, by priority (Schmidt and Budge, "Simple
// Nested Dielectrics in Ray Traced Images", JGT 2002). A path's media are sorted by rank, of one rank the one entered last first; so the
// first is the one that it is in, and none is air.
#include "materials.glsl"

// Drops the last where there is no room.
uvec4 enter_medium(uvec4 media, uint medium) {
  uint rank = medium >> MEDIUM_SURFACE_BITS;
  uvec4 ranks = media >> MEDIUM_SURFACE_BITS;
  if (media.w != 0u) atomicAdd(counters[COUNTER_MEDIA_DROPPED], 1u);
  if (rank >= ranks.x) return uvec4(medium, media.xyz);
  if (rank >= ranks.y) return uvec4(media.x, medium, media.yz);
  if (rank >= ranks.z) return uvec4(media.xy, medium, media.z);
  return uvec4(media.xyz, rank >= ranks.w ? medium : media.w);
}

uvec4 leave_medium(uvec4 media, uint medium) {
  if (media.x == medium) return uvec4(media.yzw, 0u);
  if (media.y == medium) return uvec4(media.x, media.zw, 0u);
  if (media.z == medium) return uvec4(media.xy, media.w, 0u);
  return uvec4(media.xyz, media.w == medium ? 0u : media.w);
}

bool is_within(uvec4 media, uint medium) { return any(equal(media, uvec4(medium))); }

// A path's media before a surface and beyond it.
struct Crossing {
  uvec4 before, beyond;
};

// What a path knows of its media is set right by the surface: behind it, it was inside; before a liquid's, whose sheet may have open
// sides to leave by, it was not.
Crossing cross_surface(uvec4 media, uint material, Surface surface, bool front) {
  if (surface.kind != SPECULAR_DIELECTRIC) return Crossing(media, media);
  uint medium = medium_of(surface.rank, material);
  if (front) {
    uvec4 before = surface.liquid != 0u ? leave_medium(media, medium) : media;
    return Crossing(before, enter_medium(before, medium));
  }
  uvec4 before = is_within(media, medium) ? media : enter_medium(media, medium);
  return Crossing(before, leave_medium(before, medium));
}

// No optical event: what the path is in stays the same.
bool passes_straight(Crossing crossing, Surface surface) {
  return surface.kind == SPECULAR_DIELECTRIC && crossing.before.x == crossing.beyond.x;
}

uint surface_of(uint medium) { return (medium & MEDIUM_SURFACE_MASK) - 1u; }
float medium_ior(uint medium) { return medium == 0u ? 1.0 : fetch_surface(surface_of(medium)).ior; }
vec3 medium_absorption(uint medium) { return medium == 0u ? vec3(0.0) : fetch_surface(surface_of(medium)).absorption; }

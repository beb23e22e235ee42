// What the shaders read textures by.
#ifndef MENISCAL_TEXTURES_H
#define MENISCAL_TEXTURES_H
#include "material.h"

SHARED_BEGIN

// Of one material. Textures are places in the table BIND_TEXTURES, in texels of 16 bytes; 0: none.
struct MaterialTextures {
  uint base, metallic_roughness, normal, emissive;
  float metallic, roughness;  // factors
  float least_roughness;      // that keeps a rough surface from turning smooth
  float normal_scale;
};

const uint TEXTURE_BASE = 1u, TEXTURE_METALLIC_ROUGHNESS = 2u, TEXTURE_NORMAL = 4u, TEXTURE_EMISSIVE = 8u,
           TEXTURE_DEEP = 16u;  // some have 16 bits a channel

// How a texture is read: bits, and the wrapping of its two directions.
const uint READS_DEEP = 1u, READS_NEAREST = 2u, READS_SECOND_SET = 4u;
const uint WRAP_S_SHIFT = 4u, WRAP_T_SHIFT = 6u, WRAP_MASK = 3u;
const uint WRAP_REPEAT = 0u, WRAP_CLAMP = 1u, WRAP_MIRROR = 2u;

// Cosine between a bent normal and its facet's, at the least.
const float LEAST_BENT_COSINE = 0.01f;

struct Texture {
  vec3 s;      // of (x, y, 1): the place across the image, [0, 1] once
  uint first;  // word of its texels
  vec3 t;      // downwards
  uint reading;
  uint width, height;  // texels
  uint pad0, pad1;
};

// What `raw`, the surface of a textured material as the host makes it, is where textures and factors together say this
// much. Its `specular` is that of no metal at all.
SHARED Surface textured(Surface raw, vec3 base, float metallic, float roughness) {
  Surface s = with_base(raw, base, metallic, roughness);
  s.specular = raw.specular * (raw.kind == SPECULAR_MIRROR ? 1.0f : 1.0f - metallic);
  return s;
}

SHARED_END
#endif

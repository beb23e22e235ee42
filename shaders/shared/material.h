// What a surface does, by the parameters that glTF gives a material: of all of it, or of a point where textures say more.
#ifndef MENISCAL_MATERIAL_H
#define MENISCAL_MATERIAL_H
#include "structs.h"

SHARED_BEGIN

// `s`, a dielectric's outer face, of base colour, metallic and roughness, each in [0, 1] (glTF 2.0, appendix B.2): a
// metal reflects its base colour. Smooth surfaces stay so.
SHARED Surface with_base(Surface s, vec3 base, float metallic, float roughness) {
  s.albedo = base;
  s.tint = base;
  s.f0 = mix(s.f0, base, metallic);
  s.f90 = mix(s.f90, 1.0f, metallic);
  if (s.alpha > 0.0f) s.alpha = roughness * roughness;
  return s;
}

SHARED_END
#endif

// What a surface does, by the parameters that glTF gives a material: of all of it, or of a point where textures say more.
#ifndef MENISCAL_MATERIAL_H
#define MENISCAL_MATERIAL_H
#include "structs.h"

SHARED_BEGIN

// `s`, a dielectric's outer face, of base colour, metallic and roughness, each in [0, 1] (glTF 2.0, appendix B.2): a
// metal reflects its base colour. Smooth surfaces stay so.
SHARED Surface with_base(Surface s, vec3 base, float metallic, float roughness) {
  s.albedo = base * (1.0f - metallic);
  s.tint = base;
  s.f0 = mix(s.f0, base, metallic);
  s.f90 = mix(s.f90, 1.0f, metallic);
  if (s.alpha > 0.0f) s.alpha = roughness * roughness;
  return s;
}

// Schlick's reflectance of a face that is met at this cosine.
SHARED vec3 schlick(vec3 f0, float f90, float cosine) {
  float slant = clamp(1.0f - cosine, 0.0f, 1.0f), slant2 = slant * slant;
  return f0 + (f90 - f0) * (slant2 * slant2 * slant);
}
// Of a smooth outer face above Lambert's surface (SPECULAR_MIRROR).
SHARED vec3 mirror_reflectance(Surface s, float cosine) { return schlick(s.f0, s.f90, cosine); }
// Probability that a path is reflected there; all are where nothing lies below.
SHARED float mirror_probability(Surface s, vec3 reflectance) {
  return s.albedo.x + s.albedo.y + s.albedo.z > 0.0f ? max(reflectance.x, max(reflectance.y, reflectance.z)) : 1.0f;
}

// Whether it reflects what Lambert's law does not say, where it scatters.
SHARED bool is_glossy(Surface s) {
  bool below = s.albedo.x + s.albedo.y + s.albedo.z > 0.0f;
  bool reflects = s.f0.x + s.f0.y + s.f0.z + s.f90 > 0.0f;
  return reflects && (s.kind == SPECULAR_MIRROR ? below : s.alpha > 0.0f && s.specular < 1.0f);
}

// Whether highlights are seen in it, and menisci through it: smooth, and what it reflects or lets through is all that it does.
SHARED bool shows_highlights(Surface s) {
  if (s.kind == SPECULAR_MIRROR) return s.albedo.x + s.albedo.y + s.albedo.z == 0.0f;
  return s.specular > 0.0f && s.alpha == 0.0f;
}

// Whether it bends what it lets through by microfacets.
SHARED bool is_rough_specular(Surface s) {
  return s.alpha > 0.0f && (s.kind == SPECULAR_DIELECTRIC || s.kind == SPECULAR_THIN);
}

SHARED_END
#endif

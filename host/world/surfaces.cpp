#include "host/world/surfaces.h"

#include <algorithm>

#include "shaders/shared/material.h"

namespace meniscal {

shared::Surface make_surface(const Material& m, bool closed) {
  const bool smooth = m.liquid || largest_roughness(m) < specular_roughness;
  const bool opaque_liquid = m.liquid && m.liquid->opaque;
  const double metallic = opaque_liquid ? 1 : m.metallic * m.most_metallic;
  const double transmissive = (1 - metallic) * m.transmission;
  const bool refracts = m.liquid || m.target || m.has_thickness || closed;

  shared::Surface s{};
  const double straight = (m.ior - 1) / (m.ior + 1);
  s.f0 = glm::vec3(m.specular * glm::min(straight * straight * m.specular_color, 1.0));
  s.f90 = static_cast<float>(m.specular);
  s.ior = static_cast<float>(m.ior);
  s.alpha = smooth ? 0.0f : 1.0f;
  s.emission = glm::vec3(m.emission);
  s.double_sided = m.double_sided ? 1 : 0;
  s.liquid = m.liquid || m.target ? 1 : 0;
  const bool textured = has_textures(m);
  s.albedo = glm::vec3(m.base_color);
  if (!textured) s = shared::with_base(s, s.albedo, static_cast<float>(metallic), static_cast<float>(m.roughness));
  // A material is one thing to a path: what lets more light through than it would reflect as a metal is glass.
  if (transmissive > 0 && transmissive >= metallic) {
    s.kind = refracts ? shared::SPECULAR_DIELECTRIC : shared::SPECULAR_THIN;
    s.specular = static_cast<float>(textured ? m.transmission : transmissive);
    if (refracts) s.absorption = glm::vec3(m.absorption);
  } else if (smooth && (s.f0 != glm::vec3(0) || s.f90 > 0 || metallic > 0)) {
    s.kind = shared::SPECULAR_MIRROR;
    s.specular = textured ? 1.0f : std::max(shared::mirror_probability(s, s.f0), 1e-6f);
  }
  return s;
}

}  // namespace meniscal

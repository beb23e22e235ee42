#include "host/world/surfaces.h"

#include "shaders/shared/material.h"

namespace meniscal {

shared::Surface make_surface(const Material& m, bool closed) {
  const bool smooth = m.liquid || m.roughness < specular_roughness;
  const bool opaque_liquid = m.liquid && m.liquid->opaque;
  const double mirror = smooth ? (opaque_liquid ? 1.0 : m.metallic) : 0.0;
  const double transmissive = smooth && !opaque_liquid ? (1 - m.metallic) * m.transmission : 0.0;
  // A material is one thing to a path: the roulette between specular and diffuse picks the stronger of its specular
  // sides.
  const bool transmits = transmissive > mirror;
  const bool refracts = m.liquid || m.target || m.has_thickness || closed;

  shared::Surface s{};
  s.specular = static_cast<float>(transmits ? transmissive : mirror);
  s.kind = s.specular == 0 ? shared::SPECULAR_NONE
           : !transmits    ? shared::SPECULAR_MIRROR
           : refracts      ? shared::SPECULAR_DIELECTRIC
                           : shared::SPECULAR_THIN;
  s.ior = static_cast<float>(m.ior);
  if (s.kind == shared::SPECULAR_DIELECTRIC) s.absorption = glm::vec3(m.absorption);
  s.alpha = smooth ? 0.0f : 1.0f;
  const double straight = (m.ior - 1) / (m.ior + 1);
  s.f0 = glm::vec3(static_cast<float>(m.specular * straight * straight));
  s.f90 = static_cast<float>(m.specular);
  s.emission = glm::vec3(m.emission);
  s.double_sided = m.double_sided ? 1 : 0;
  s.liquid = m.liquid || m.target ? 1 : 0;
  return shared::with_base(s, glm::vec3(m.base_color), static_cast<float>(m.metallic), static_cast<float>(m.roughness));
}

}  // namespace meniscal

// A point of the band raised to the meniscus, with the normal that the height function has there.
#pragma once

#include "meniscus/field.h"

namespace meniscus {

struct Lifted {
  glm::dvec3 position;
  glm::dvec3 normal;  // unit
};

// `base` on the level liquid, with its unit normal. Displaces by the rise times its falloff along that normal and by
// the contact line's slide, passing over linearly into what is left of it at its reach, along the contour normal; the
// normal is the cross product of the two derivatives of this displacement, along and across the contour. Beyond the
// sweep length nothing changes.
Lifted lift(const Foot& foot, double sweep, Profile profile, const glm::dvec3& base, const glm::dvec3& liquid_normal);

}  // namespace meniscus

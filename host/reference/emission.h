// Photons as lights emit them: the specification of shaders/emission.glsl.
#pragma once

#include "host/reference/path.h"

namespace meniscal::reference {

struct Emission {
  Ray ray;
  glm::dvec3 flux;         // of all photons
  std::uint32_t triangle;  // of an area light
  glm::uvec4 media;        // that the light is inside of
};

// From one of the lights, by power. `place`, uniform in the square: where on the disc across a distant light's
// direction, or where to from others.
Emission emit(const Tracer& tracer, const glm::dvec2& place, const shared::RandomKey& key);

}  // namespace meniscal::reference

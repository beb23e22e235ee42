// Highlights: lights that a pixel sees in menisci, next to none too thin (paper section 4.1). The specification of
// shaders/highlights.comp.
#pragma once

#include "host/reference/camera.h"

namespace meniscal::reference {

// Mean radiance, over pixel (x, y), of the lights that it sees at once in menisci, directly or through other surfaces.
// Each of the pixel's cells sends one ray; its derivatives tell which part of the cell sees which part of a light, so
// that a highlight that is thinner than a cell is seen as bright as it is (in place of the paper's normals, taken at
// random, which would miss it). Lights without extent are seen as discs of half a degree.
glm::dvec3 highlight(const Tracer& tracer, const RenderSettings& settings, const CameraAxes& axes, std::uint32_t pass,
                     std::uint32_t x, std::uint32_t y);

}  // namespace meniscal::reference

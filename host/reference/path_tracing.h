// Path tracing: a yardstick that knows no photons.
#pragma once

#include "host/reference/camera.h"

namespace meniscal::reference {

// The path of pixel (x, y) in a pass. At each diffuse surface it asks the lights; a light that is met behind specular
// surfaces counts then and there, which is the only way to a caustic: those of point, spot and parallel lights are
// missing. The sample's `direct` is the first diffuse surface's, all that is reflected after it its `emitted`.
CameraSample trace_whole_path(const Tracer& tracer, const RenderSettings& settings, const CameraAxes& axes,
                              std::uint32_t pass, std::uint32_t sample, std::uint32_t x, std::uint32_t y);

}  // namespace meniscal::reference

// One camera path: the specification of shaders/camera.comp.
#pragma once

#include "host/reference/path.h"
#include "host/render/backend.h"

namespace meniscal::reference {

// The path of pixel (x, y) in a pass: to the first diffuse surface, lit directly; its map irradiances are left at 0.
shared::PixelSample trace_camera_path(const Tracer& tracer, const RenderSettings& settings, const CameraAxes& axes,
                                      std::uint32_t pass, const View& view, std::uint32_t x, std::uint32_t y);

}  // namespace meniscal::reference

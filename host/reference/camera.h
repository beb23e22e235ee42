// One camera path: the specification of shaders/camera.comp.
#pragma once

#include "host/reference/path.h"
#include "host/render/backend.h"

namespace meniscal::reference {

// `pixel`: a place in pixels, from the image's upper left corner.
Path camera_ray(const RenderSettings& settings, const CameraAxes& axes, const glm::dvec2& pixel);

// From one of the lights, seen from a diffuse surface's `side`; `absorption`: of the medium there, 1/m.
glm::dvec3 direct_irradiance(const Tracer& tracer, const Hit& hit, const glm::dvec3& side, const glm::dvec3& shading,
                             const glm::dvec3& absorption, const shared::RandomKey& key);

// The path of pixel (x, y) in a pass: to the first diffuse surface, lit directly; its map irradiances are left at 0.
shared::PixelSample trace_camera_path(const Tracer& tracer, const RenderSettings& settings, const CameraAxes& axes,
                                      std::uint32_t pass, const View& view, std::uint32_t x, std::uint32_t y);

}  // namespace meniscal::reference

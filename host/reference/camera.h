// One camera path: the specification of shaders/camera.comp.
#pragma once

#include <optional>

#include "host/reference/scattering.h"
#include "host/render/backend.h"

namespace meniscal::reference {

// `pixel`: a place in pixels, from the image's upper left corner.
Path camera_ray(const RenderSettings& settings, const CameraAxes& axes, const glm::dvec2& pixel);

// What one of the lights, picked by `key`, gives a diffuse surface without anything between; `absorption`: of the
// medium there, 1/m.
struct Direct {
  glm::dvec3 irradiance{0};
  glm::dvec3 beyond_lambert{0};  // radiance that the outer face adds to Lambert's
};
// `bounced`: lobes by which other paths leave the surface and meet the lights; their light is shared out between both
// by the balance heuristic (Veach 1997). None: all of it is the lights' own.
Direct ask_lights(const Tracer& tracer, const DiffusePoint& point, const glm::dvec3& absorption,
                  std::optional<Lobes> bounced, const shared::RandomKey& key);
// The part that a path has, by the density of its direction, of what it sees of a light that others have by `other`.
inline double balance(double own, double other) { return own > 0 ? own / (own + other) : 0; }

// By which the views' bounced paths leave the surfaces that the camera sees.
inline Lobes bounced_lobes(const RenderSettings& settings) {
  return settings.final_gathering ? Lobes::both : Lobes::gloss;
}

// What a camera path tells; gloss only where the scene has outer faces that reflect.
struct CameraSample {
  shared::PixelSample pixel{};
  shared::PixelGloss gloss{};
};
// The path of pixel (x, y) in a pass: to the first diffuse surface, lit directly; its map irradiances are left at 0.
CameraSample trace_camera_path(const Tracer& tracer, const RenderSettings& settings, const CameraAxes& axes,
                               std::uint32_t pass, const View& view, std::uint32_t x, std::uint32_t y);

}  // namespace meniscal::reference

// The camera as the shaders have it.
#pragma once

#include "host/render/settings.h"
#include "shaders/shared/structs.h"

namespace meniscal::passes {

inline shared::CameraView camera_view(const RenderSettings& settings, std::uint32_t pass) {
  const CameraAxes axes = camera_axes(settings.camera, settings.width, settings.height);
  shared::CameraView view{};
  view.right = glm::vec4(axes.right, 0);
  view.up = glm::vec4(axes.up, 0);
  view.forward = axes.forward;
  view.origin = axes.origin;
  view.orthographic = settings.camera.orthographic ? 1 : 0;
  view.width = settings.width;
  view.height = settings.height;
  view.crop_x = settings.crop.x0;
  view.crop_y = settings.crop.y0;
  view.crop_width = settings.crop.width();
  view.media = settings.camera_media;
  view.jitter = pixel_jitter(settings, pass);
  view.most_shift = static_cast<float>(most_shift(settings));
  return view;
}

}  // namespace meniscal::passes

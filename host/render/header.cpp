#include "host/render/header.h"

#include <glm/gtc/matrix_transform.hpp>

namespace meniscal {
namespace {

// OpenEXR multiplies row vectors: GLM's columns are its rows.
std::array<float, 16> rows(const glm::dmat4& m) {
  std::array<float, 16> values{};
  for (int i = 0; i < 16; ++i) values[i] = static_cast<float>(m[i / 4][i % 4]);
  return values;
}

glm::dmat4 projection(const RenderSettings& settings) {
  const CameraAxes axes = camera_axes(settings.camera, settings.width, settings.height);
  const double half_width = glm::length(axes.right), half_height = glm::length(axes.up);
  const double near = std::max(settings.camera.znear, 1e-4), far = 1e4 * near;
  if (settings.camera.orthographic) return glm::ortho(-half_width, half_width, -half_height, half_height, near, far);
  return glm::frustum(-half_width * near, half_width * near, -half_height * near, half_height * near, near, far);
}

}  // namespace

void describe(Image& image, const Scene& scene, const RenderSettings& settings, MeniscusModel model,
              const RunStatistics& run, double render_seconds) {
  image.text["software"] = "meniscal " MENISCAL_VERSION;
  image.text["sceneHash"] = scene.hash;
  image.text["meniscusModel"] = model == MeniscusModel::none ? "none" : "paper";
  image.text["passRange"] = std::to_string(run.passes.first) + ":" + std::to_string(run.passes.last);
  image.numbers["seed"] = settings.seed;
  image.numbers["photonsPerPass"] = settings.caustics.count();
  image.numbers["specularBounces"] = settings.specular_bounces;
  if (!settings.caustics.beams.empty()) image.numbers["radius"] = disc_radius(settings, 0);
  image.numbers["renderTime"] = render_seconds;

  glm::dmat4 to_world = settings.camera.pose;
  to_world[3] += glm::dvec4(scene.origin, 0);
  const glm::dmat4 to_camera = glm::inverse(to_world);
  image.matrices["worldToCamera"] = rows(to_camera);
  image.matrices["worldToNDC"] = rows(projection(settings) * to_camera);
}

}  // namespace meniscal

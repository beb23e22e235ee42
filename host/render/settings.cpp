#include "host/render/settings.h"

#include <algorithm>

#include "host/world/triangles.h"

namespace meniscal {

CameraAxes camera_axes(const Camera& camera, std::uint32_t width, std::uint32_t height) {
  const double image_aspect = double(width) / height;
  const glm::dmat3 rotation(camera.pose);
  double half_height = std::tan(camera.yfov / 2), half_width = half_height * image_aspect;
  if (camera.orthographic) {
    half_height = camera.ymag;
    half_width = camera.ymag * image_aspect;
    // A square view in a wider image keeps its width as well as its height in sight.
    if (half_width < camera.xmag) half_width = camera.xmag, half_height = camera.xmag / image_aspect;
  }
  const glm::dvec3 right = glm::normalize(rotation[0]), up = glm::normalize(rotation[1]),
                   back = glm::normalize(rotation[2]);
  glm::dvec3 origin(camera.pose[3]);
  return {half_width * right, half_height * up, -back, origin};
}

double disc_radius(const RenderSettings& settings, std::uint32_t pass) {
  const Discs discs = pass_discs(settings.caustics.discs, pass);
  double reach = discs.widest;
  for (const shared::Beam& b : settings.caustics.beams) reach = std::min(reach, discs.shrink * double(b.reach));
  return std::clamp(reach, discs.narrowest, discs.widest);
}

namespace {

// Distance along a ray to the nearest diffuse triangle; infinite where there is none. Refraction is left out: it is a
// size that is wanted.
double diffuse_distance(const World& world, const glm::dvec3& origin, const glm::dvec3& direction) {
  double nearest = INFINITY;
  for (const WorldTriangle& t : world.triangles) {
    if (world.surfaces[t.material].specular > 0.5f) continue;
    const double cosine = glm::dot(t.geometric, direction);
    const double distance = glm::dot(t.corner[0] - origin, t.geometric) / cosine;
    if (!(distance > 0 && distance < nearest)) continue;
    if (is_over(t, origin + distance * direction)) nearest = distance;
  }
  return nearest;
}

}  // namespace

double pixel_footprint(const World& world, const RenderSettings& settings) {
  const CameraAxes axes = camera_axes(settings.camera, settings.width, settings.height);
  const double per_pixel = pixel_side(axes, settings.height);
  if (settings.camera.orthographic) return per_pixel;
  std::vector<double> distances;
  for (double y : {-0.4, 0.0, 0.4}) {
    const double d = diffuse_distance(world, axes.origin, glm::normalize(axes.forward + y * axes.up));
    if (std::isfinite(d)) distances.push_back(d);
  }
  if (distances.empty()) return per_pixel * std::max(glm::length(axes.origin), 0.1 * world.radius);
  std::sort(distances.begin(), distances.end());
  return per_pixel * distances[distances.size() / 2];
}

}  // namespace meniscal

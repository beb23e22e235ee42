#include "host/world/light_width.h"

#include <algorithm>
#include <limits>

namespace meniscal {
namespace {

struct Extent {
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-low};
  double area = 0;
  glm::dvec3 middle() const { return 0.5 * (low + high); }
  double diagonal() const { return glm::distance(low, high); }
};

Extent extent_of(const meniscus::TriangleMesh& mesh) {
  Extent extent;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
    for (const glm::dvec3& p : {a, b, c}) extent.low = glm::min(extent.low, p), extent.high = glm::max(extent.high, p);
    extent.area += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  return extent;
}

}  // namespace

double narrowest_light(const Scene& scene) {
  if (scene.environment) return 0;
  std::vector<Extent> liquids;
  for (const Object& object : scene.objects)
    if (scene.materials[object.material].liquid) liquids.push_back(extent_of(object.mesh));
  double narrowest = std::numeric_limits<double>::infinity();
  for (const PunctualLight& light : scene.lights)
    narrowest = std::min(narrowest, light.type == PunctualLight::Type::directional ? light.angular_diameter : 0);
  for (const Object& lamp : scene.objects) {
    const Material& material = scene.materials[lamp.material];
    if (material.emission == glm::dvec3(0)) continue;
    if (material.emissive_texture) return 0;
    const Extent light = extent_of(lamp.mesh);
    if (!(light.area > 0)) continue;
    for (const Extent& liquid : liquids) {
      const double distance = glm::distance(light.middle(), liquid.middle()) + 0.5 * liquid.diagonal();
      // Of a rectangle no less than seven tenths of its narrow side; of many small lamps in one mesh less than all. A
      // convex body is seen, in the mean, as a quarter of its area.
      narrowest = std::min(narrowest, light.area / (lamp.closed ? 4 : 1) / light.diagonal() / distance);
    }
  }
  return narrowest;
}

}  // namespace meniscal

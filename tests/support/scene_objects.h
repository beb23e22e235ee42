// Objects and views that tests add to scenes.
#pragma once

#include <utility>

#include "host/scene/scene.h"

namespace meniscal::test {

// Closed, faces outward.
inline Object make_box(const std::string& name, int material, const glm::dvec3& low, const glm::dvec3& high) {
  Object box;
  box.name = name;
  box.closed = true;
  box.material = material;
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2, side = face % 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto first = static_cast<std::uint32_t>(box.mesh.positions.size());
    for (const auto& [cu, cv] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
      glm::dvec3 p, n(0);
      p[axis] = (side ? high : low)[axis], p[u] = (cu ? high : low)[u], p[v] = (cv ? high : low)[v];
      n[axis] = side ? 1 : -1;
      box.mesh.positions.push_back(p);
      box.mesh.normals.push_back(n);
    }
    const std::uint32_t b = first + (side ? 1 : 2), c = first + (side ? 2 : 1), d = first + 3;
    box.mesh.triangles.emplace_back(first, b, c);
    if (side)
      box.mesh.triangles.emplace_back(first, c, d);
    else
      box.mesh.triangles.emplace_back(first, d, b);
  }
  return box;
}

inline Material make_clear(const std::string& name, double ior) {
  Material material;
  material.name = name;
  material.metallic = material.roughness = 0;
  material.transmission = 1;
  material.ior = ior;
  return material;
}

// Scales and then moves an object, in the scene's own coordinates.
inline void move(Scene& scene, const std::string& name, const glm::dvec3& scale, const glm::dvec3& shift) {
  for (Object& o : scene.objects)
    if (o.name == name)
      for (glm::dvec3& p : o.mesh.positions) p = (p + scene.origin) * scale + shift - scene.origin;
}

// The first camera looks straight down, `half` to each side.
inline void look_down_on(Scene& scene, const glm::dvec3& from, double half) {
  Camera& camera = scene.cameras[0];
  camera.orthographic = true;
  camera.xmag = camera.ymag = half;
  camera.pose = glm::dmat4(glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 0, -1, 0), glm::dvec4(0, 1, 0, 0),
                           glm::dvec4(from - scene.origin, 1));
}

}  // namespace meniscal::test

// Light from beyond the scene, for tests.
#pragma once

#include <algorithm>
#include <functional>
#include <string>

#include "host/scene/scene.h"

namespace meniscal::test {

// `radiance`: by row and column.
inline Environment make_sky(int width, int height, const std::function<glm::vec3(int, int)>& radiance) {
  Environment sky{width, height, {}, 0};
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) sky.radiance.push_back(radiance(row, column));
  return sky;
}

// All light is that of this sky.
inline void light_by(Scene& scene, const Environment& sky) {
  scene.lights.clear();
  for (Material& m : scene.materials) m.emission = glm::dvec3(0);
  scene.environment = sky;
}

// A clear day: colours that go over into each other, a bright spot, and darkness below.
inline Environment day() {
  return make_sky(32, 16, [](int row, int column) {
    if (row == 3 && column == 9) return glm::vec3(60, 56, 48);
    return row < 8 ? glm::vec3(0.5f, 0.7f, 1.0f) * (0.2f + 0.05f * float(row)) : glm::vec3(0.05f, 0.04f, 0);
  });
}

// Turns all directional lights into suns so wide, in degrees.
inline void widen_suns(Scene& scene, double diameter) {
  for (PunctualLight& l : scene.lights)
    if (l.type == PunctualLight::Type::directional) l.angular_diameter = glm::radians(diameter);
}

// Of a scene's name: the file's, and what is changed of it. "NAME-sun": half a degree; "NAME-wide_sun": 20 degrees;
// "NAME-day": the sky alone, turned.
struct NamedLight {
  std::string file;
  std::function<void(Scene&)> edit;
};
inline NamedLight named_light(const std::string& name) {
  const std::size_t dash = name.find('-');
  const std::string light = dash == std::string::npos ? "" : name.substr(dash + 1);
  if (light == "sun") return {name.substr(0, dash), [](Scene& scene) { widen_suns(scene, 0.53); }};
  if (light == "wide_sun") return {name.substr(0, dash), [](Scene& scene) { widen_suns(scene, 20); }};
  if (light == "day")
    return {name.substr(0, dash), [](Scene& scene) {
              light_by(scene, day());
              scene.environment->rotation = 0.4;
            }};
  return {name, {}};
}

// For INSTANTIATE_TEST_SUITE_P: the name without its dash.
inline const auto name_of_test = [](const auto& tested) {
  std::string name = tested.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
};

}  // namespace meniscal::test

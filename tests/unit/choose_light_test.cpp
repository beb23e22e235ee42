// Which light a visible point asks: in the mean over many, every light gives what it would if all were asked.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "host/reference/path.h"
#include "host/world/world.h"

namespace meniscal {
namespace {

using glm::dvec3;

// Parallel lights from all round, of intensities 1, 2, 3, 4, 1, ...; the first one comes from below.
World world_of_lights(std::size_t count) {
  Scene scene = load_gltf(std::string(SCENES) + "/post.gltf");
  const PunctualLight usual = scene.lights[0];
  scene.lights.assign(count, usual);
  for (std::size_t i = 0; i < count; ++i) {
    const double turn = 2 * glm::pi<double>() * (double(i) + 0.4) / double(count);
    scene.lights[i].direction = -dvec3(std::cos(turn), -std::sin(turn), 0);
    scene.lights[i].intensity = dvec3(1, 0.5, 0.25) * double(1 + i % 4);
  }
  return build_world(scene, MeniscusModel::none);
}

class ChooseLight : public testing::TestWithParam<std::size_t> {};

TEST_P(ChooseLight, GivesOfEveryLightWhatItGives) {
  const World world = world_of_lights(GetParam());
  ASSERT_EQ(world.lights.size(), GetParam());
  const dvec3 point(0, 1e-3, 0), normal(0, 1, 0);
  const auto given_by = [&](const reference::LightSample& s) {
    return s.irradiance.x * std::max(glm::dot(s.direction, normal), 0.0);
  };
  constexpr std::uint32_t asked = 20000;
  std::vector<double> given(world.lights.size());
  for (std::uint32_t i = 0; i < asked; ++i) {
    // By pixels, passes and a pixel's samples, as camera paths do.
    const shared::RandomKey key{1, i / 16 % 25, shared::STREAM_CAMERA + i % 16, i / 400};
    for (std::uint32_t k = 0; k < std::min<std::size_t>(given.size(), shared::LIGHTS_ASKED); ++k) {
      const reference::LightSample s = reference::choose_light(world, point, normal, key, k);
      for (std::size_t light = 0; light < given.size(); ++light)
        if (glm::distance(s.direction, -dvec3(world.lights[light].direction)) < 1e-6)
          given[light] += given_by(s) / asked;
    }
  }
  double sum = 0;
  for (std::uint32_t light = 0; light < given.size(); ++light)
    sum += given_by(reference::sample_light(world, light, 1, point, glm::dvec2(0.5)));
  ASSERT_GT(sum, 0);
  for (std::uint32_t light = 0; light < given.size(); ++light) {
    const double alone = given_by(reference::sample_light(world, light, 1, point, glm::dvec2(0.5)));
    EXPECT_NEAR(given[light], alone, 4 * std::sqrt(alone * sum / asked)) << "light " << light;
  }
}
INSTANTIATE_TEST_SUITE_P(Lights, ChooseLight, testing::Values(2, 3, 5, 8, 20));

}  // namespace
}  // namespace meniscal

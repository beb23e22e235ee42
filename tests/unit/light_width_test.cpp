// How wide lights are, and how many rays look for them in menisci by default.
#include "host/world/light_width.h"

#include <cmath>

#include "gtest/gtest.h"
#include "host/cli/render_settings.h"

namespace meniscal {
namespace {

meniscus::TriangleMesh rectangle(double width, double depth, double height) {
  const double x = width / 2, z = depth / 2;
  return {{{-x, height, -z}, {x, height, -z}, {x, height, z}, {-x, height, z}}, {}, {{0, 1, 2}, {0, 2, 3}}};
}

// A lamp of 0.2 m above water of 3 x 4 cm.
Scene lit_by_a_lamp(double narrow_side) {
  Scene scene;
  scene.materials.resize(2);
  scene.materials[0].liquid.emplace();
  scene.materials[1].emission = glm::dvec3(1);
  scene.objects.resize(2);
  scene.objects[0].mesh = rectangle(0.03, 0.04, 0), scene.objects[0].material = 0;
  scene.objects[1].mesh = rectangle(narrow_side, 0.2, 0.975), scene.objects[1].material = 1;
  return scene;
}

TEST(LightWidth, IsTheAngleOfTheNarrowSideFromTheFarEndOfTheLiquid) {
  EXPECT_NEAR(narrowest_light(lit_by_a_lamp(0.001)), 0.001, 1e-7);  // 0.975 m and half of 5 cm
  EXPECT_NEAR(narrowest_light(lit_by_a_lamp(0.2)), 0.2 / std::sqrt(2), 1e-7);
}

TEST(LightWidth, IsASunsDiameter) {
  Scene scene = lit_by_a_lamp(0.2);
  scene.lights.emplace_back().type = PunctualLight::Type::directional;
  scene.lights.back().angular_diameter = 0.01;
  EXPECT_EQ(narrowest_light(scene), 0.01);
  scene.lights.emplace_back().type = PunctualLight::Type::point;
  EXPECT_EQ(narrowest_light(scene), 0);
}

TEST(LightWidth, IsNoneWithALightThatIsAPointOrOfUnknownSharpness) {
  Scene sunny = lit_by_a_lamp(0.2), sky = sunny, image = sunny;
  sunny.lights.emplace_back().type = PunctualLight::Type::directional;
  EXPECT_EQ(narrowest_light(sunny), 0);
  sky.environment.emplace();
  EXPECT_EQ(narrowest_light(sky), 0);
  image.materials[1].emissive_texture.emplace();
  EXPECT_EQ(narrowest_light(image), 0);
}

TEST(LightWidth, AsksForMoreHighlightSamplesWhereItIsNarrow) {
  RenderOptions options;
  for (const Quality quality : {Quality::draft, Quality::preview, Quality::final}) {
    options.quality = quality;
    EXPECT_EQ(highlight_samples_of(options, lit_by_a_lamp(0.001)), preset(quality).spark_samples);
    EXPECT_EQ(highlight_samples_of(options, lit_by_a_lamp(0.2)), 16u);
  }
  EXPECT_GT(preset(Quality::final).spark_samples, 16u);
  options.highlight_samples = 9;
  EXPECT_EQ(highlight_samples_of(options, lit_by_a_lamp(0.001)), 9u);
}

}  // namespace
}  // namespace meniscal

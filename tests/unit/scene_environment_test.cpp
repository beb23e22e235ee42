// The image that a scene's extras name as its environment.
#include <cmath>
#include <limits>

#include "host/image/exr.h"
#include "tests/unit/scene_fixture.h"

namespace meniscal::testing {
namespace {

class SceneEnvironment : public SceneFiles {
 protected:
  void write_sky(int width, int height, std::vector<float> pixels,
                 std::vector<std::string> channels = {"R", "G", "B"}) {
    Image image;
    image.width = width, image.height = height;
    image.layers.push_back({"", std::move(channels), std::move(pixels)});
    write_exr((folder / "sky.exr").string(), image);
  }
  Document under_sky(Json more = Json::object()) {
    Document document = triangle();
    document.json["scenes"][0]["name"] = "outdoors";
    document.json["scenes"][0]["extras"] = {{"environment", "sky.exr"}};
    document.json["scenes"][0]["extras"].update(more);
    return document;
  }
};

TEST_F(SceneEnvironment, IsReadTurnedAndScaled) {
  write_sky(2, 1, {1, 2, 3, 4, 5, 6});
  const Scene scene = load(under_sky({{"environment_rotation", 90}, {"environment_strength", 2}}));
  ASSERT_TRUE(scene.environment);
  EXPECT_EQ(scene.environment->width, 2);
  EXPECT_EQ(scene.environment->height, 1);
  EXPECT_EQ(scene.environment->radiance, (std::vector<glm::vec3>{{2, 4, 6}, {8, 10, 12}}));
  EXPECT_NEAR(scene.environment->rotation, std::acos(-1) / 2, 1e-12);
  EXPECT_EQ(count_warnings(scene, {"neither a light"}), 0u);
  EXPECT_EQ(count_warnings(scene, {"environment"}), 0u);
}

TEST_F(SceneEnvironment, MayBeGreyOrHaveMoreChannels) {
  write_sky(2, 1, {3, 4}, {"Y"});
  EXPECT_EQ(load(under_sky()).environment->radiance[1], glm::vec3(4));
  write_sky(2, 1, {1, 2, 3, 0.5f, 4, 5, 6, 0.5f}, {"R", "G", "B", "A"});
  EXPECT_EQ(load(under_sky()).environment->radiance[1], glm::vec3(4, 5, 6));
  write_sky(2, 1, {1, 2}, {"Z"});
  expect_error(under_sky().text(), {"environment \"sky.exr\"", "R, G, B"});
}

TEST_F(SceneEnvironment, IsAStageOfLoadingWhereThereIsOne) {
  EXPECT_TRUE(load(triangle()).stages.seconds().empty());
  write_sky(2, 1, {1, 2, 3, 4, 5, 6});
  const auto seconds = load(under_sky()).stages.seconds();
  EXPECT_EQ(seconds.size(), 1u);
  EXPECT_TRUE(seconds.contains("environment image"));
}

// Merging and checkpoints tell scenes apart by their hash.
TEST_F(SceneEnvironment, ContentsAreInTheHash) {
  write_sky(2, 1, {1, 2, 3, 4, 5, 6});
  const std::string hash = load(under_sky()).hash;
  EXPECT_EQ(load(under_sky()).hash, hash);
  write_sky(2, 1, {1, 2, 3, 4, 5, 7});
  EXPECT_NE(load(under_sky()).hash, hash);
}

TEST_F(SceneEnvironment, OddOnesAreMentioned) {
  constexpr float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  write_sky(2, 1, {1, -2, 3, infinity, nan, 6});
  Scene scene = load(under_sky());
  EXPECT_EQ(scene.environment->radiance, (std::vector<glm::vec3>{{1, 0, 3}, {0, 0, 6}}));
  EXPECT_EQ(count_warnings(scene, {"environment \"sky.exr\"", "3 numbers"}), 1u);
  write_sky(1, 1, {1, 2, 3});
  EXPECT_EQ(count_warnings(load(under_sky()), {"sky.exr", "1 x 1", "twice as wide"}), 1u);
  write_sky(2, 1, {0, 0, 0, 0, 0, -1});
  scene = load(under_sky());
  EXPECT_FALSE(scene.environment);
  EXPECT_EQ(count_warnings(scene, {"sky.exr", "black"}), 1u);
  EXPECT_EQ(count_warnings(scene, {"neither a light"}), 1u);
}

TEST_F(SceneEnvironment, UnusableOnesAreErrors) {
  expect_error(under_sky(), {"sky.exr", "no such file"});
  write(folder / "sky.exr", "no image");
  expect_error(under_sky(), {"environment \"sky.exr\"", "not a readable EXR image"});
  write(root / "sky.exr", "outside");
  expect_error(under_sky({{"environment", "../sky.exr"}}), {"../sky.exr", "leads out"});
  expect_error(under_sky({{"environment", 3}}), {"outdoors", "environment"});
  write_sky(2, 1, {1, 2, 3, 4, 5, 6});
  expect_error(under_sky({{"environment_strength", -1}}), {"outdoors", "environment_strength"});
  Image part;
  part.width = part.height = 1, part.full_width = 2, part.full_height = 1;
  part.layers.push_back({"", {"R", "G", "B"}, {1, 2, 3}});
  write_exr((folder / "sky.exr").string(), part);
  expect_error(under_sky(), {"sky.exr", "part of an image"});
}

}  // namespace
}  // namespace meniscal::testing

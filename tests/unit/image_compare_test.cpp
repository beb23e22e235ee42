// The figures of `compare` on images whose differences are known by hand.
#include <cmath>
#include <limits>

#include "gtest/gtest.h"
#include "host/error.h"
#include "host/image/compare.h"

namespace meniscal {
namespace {

Image image_of(int width, int height, std::vector<Layer> layers) {
  Image image;
  image.width = width, image.height = height;
  image.layers = std::move(layers);
  return image;
}

TEST(Compare, OfAnImageWithItselfFindsNothing) {
  const Image a = image_of(2, 1, {{"", {"R", "G", "B"}, {1, 2, 3, 4, 5, 6}}});
  const LayerDifference d = compare(a, "a", a, "b").at(0);
  EXPECT_EQ(d.rmse, 0);
  EXPECT_EQ(d.relative_rmse, 0);
  EXPECT_EQ(d.max_difference, 0);
  EXPECT_EQ(d.mean_ratio, 1);
  EXPECT_EQ(d.samples, 6u);
  EXPECT_EQ(d.non_finite, 0u);
}

TEST(Compare, GivesTheFiguresComputedByHand) {
  // Differences 1, 0, -2, 0: rmse sqrt(5/4); reference rms sqrt((9 + 1 + 16 + 4)/4); means 9/4 and 10/4.
  Image a = image_of(2, 2, {{"", {"Y"}, {4, 1, 2, 2}}}), b = image_of(2, 2, {{"", {"Y"}, {3, 1, 4, 2}}});
  a.x0 = b.x0 = 10, a.y0 = b.y0 = 20;
  const LayerDifference d = compare(a, "a", b, "b").at(0);
  EXPECT_NEAR(d.rmse, std::sqrt(5 / 4.0), 1e-12);
  EXPECT_NEAR(d.relative_rmse, std::sqrt(5 / 30.0), 1e-12);
  EXPECT_NEAR(d.mean_ratio, 0.9, 1e-12);
  EXPECT_EQ(d.max_difference, 2);
  EXPECT_EQ(std::make_tuple(d.max_x, d.max_y, d.max_channel), std::make_tuple(10, 21, "Y"));
}

TEST(Compare, MatchesLayersAndChannelsByName) {
  const Image a = image_of(1, 1, {{"", {"R", "G", "B"}, {1, 2, 3}}, {"only_a", {"Z"}, {1}}, {"depth", {"Z"}, {5}}});
  const Image b = image_of(1, 1, {{"depth", {"Z"}, {4}}, {"", {"A", "B", "R"}, {9, 7, 1}}, {"only_b", {"Z"}, {1}}});
  const std::vector<LayerDifference> d = compare(a, "a", b, "b");
  ASSERT_EQ(d.size(), 2u);
  EXPECT_EQ(d[0].channels, (std::vector<std::string>{"R", "B"}));
  EXPECT_EQ(d[0].max_difference, 4);
  EXPECT_EQ(d[0].max_channel, "B");
  EXPECT_EQ(d[1].layer, "depth");
  EXPECT_EQ(d[1].relative_rmse, 0.25);
}

TEST(Compare, CountsWhatIsNotFiniteAndLeavesItOut) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  const Image a = image_of(4, 1, {{"", {"Y"}, {nan, 1, 3, infinity}}}),
              b = image_of(4, 1, {{"", {"Y"}, {1, nan, 2, infinity}}});
  const LayerDifference d = compare(a, "a", b, "b").at(0);
  EXPECT_EQ(d.non_finite, 3u);
  EXPECT_EQ(d.samples, 1u);
  EXPECT_EQ(d.rmse, 1);
  EXPECT_EQ(d.relative_rmse, 0.5);
}

TEST(Compare, ToldApartFromABlackReference) {
  const Image black = image_of(1, 1, {{"", {"Y"}, {0}}}), lit = image_of(1, 1, {{"", {"Y"}, {2}}});
  EXPECT_EQ(compare(black, "a", black, "b").at(0).relative_rmse, 0);
  EXPECT_EQ(compare(black, "a", black, "b").at(0).mean_ratio, 1);
  EXPECT_TRUE(std::isinf(compare(lit, "a", black, "b").at(0).relative_rmse));
}

TEST(Compare, RefusesOtherWindowsAndOtherLayers) {
  const Image a = image_of(2, 1, {{"", {"Y"}, {1, 2}}}), other_size = image_of(1, 2, {{"", {"Y"}, {1, 2}}});
  const Image other_layer = image_of(2, 1, {{"depth", {"Z"}, {1, 2}}});
  Image moved = a;
  moved.x0 = 1;
  for (const Image* b : {&other_size, &other_layer, static_cast<const Image*>(&moved)}) {
    try {
      compare(a, "first.exr", *b, "second.exr");
      ADD_FAILURE() << "compared";
    } catch (const Error& error) {
      EXPECT_EQ(error.code, ExitCode::scene);
      EXPECT_NE(std::string(error.what()).find("first.exr"), std::string::npos);
      EXPECT_NE(std::string(error.what()).find("second.exr"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace meniscal

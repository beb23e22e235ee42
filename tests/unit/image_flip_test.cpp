// FLIP against values worked out from its paper.
#include <random>

#include "gtest/gtest.h"
#include "host/image/flip.h"

namespace meniscal {
namespace {

using Bytes = std::vector<std::uint8_t>;
constexpr int kWidth = 48, kHeight = 32;

Bytes uniform(std::uint8_t r, std::uint8_t g, std::uint8_t b) {
  Bytes bytes;
  for (int i = 0; i < kWidth * kHeight; ++i) bytes.insert(bytes.end(), {r, g, b});
  return bytes;
}
double mean(const Bytes& a, const Bytes& b) { return flip(a, b, kWidth, kHeight).mean; }

Bytes noisy(const Bytes& bytes, double deviation) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, deviation);
  Bytes result;
  for (const std::uint8_t v : bytes)
    result.push_back(static_cast<std::uint8_t>(std::clamp(double(v) + noise(random), 0.0, 255.0)));
  return result;
}

// Discs of colours on grey.
Bytes picture(int shift = 0) {
  Bytes bytes = uniform(100, 110, 120);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      if (std::hypot(x - 20 - shift, y - 15) < 6) {
        bytes[3 * (y * kWidth + x)] = 220;
        bytes[3 * (y * kWidth + x) + 2] = 30;
      }
  return bytes;
}

TEST(Flip, IsZeroForEqualPicturesAlone) {
  EXPECT_EQ(mean(picture(), picture()), 0);
  EXPECT_GT(mean(picture(), picture(1)), 0.001);
}

TEST(Flip, IsSymmetric) {
  const Flip ab = flip(picture(), picture(3), kWidth, kHeight), ba = flip(picture(3), picture(), kWidth, kHeight);
  EXPECT_EQ(ab.pixels, ba.pixels);
}

TEST(Flip, LiesBetweenZeroAndOne) {
  const std::pair<Bytes, Bytes> extremes[] = {{uniform(0, 0, 0), noisy(uniform(128, 128, 128), 1000)},
                                              {uniform(0, 255, 0), uniform(0, 0, 255)},
                                              {uniform(255, 0, 0), uniform(0, 0, 255)}};
  for (const auto& [a, b] : extremes)
    for (const float v : flip(a, b, kWidth, kHeight).pixels) {
      EXPECT_GE(v, 0);
      EXPECT_LE(v, 1);
    }
}

// Uniform pictures have no features, and pass filters as they are. Black and white are |L - L'| = 100 apart, which is
// 100^0.7 = 25.1189; green and blue, the paper's greatest difference, 203.2806 with Hunt's L*a*b* (87.735, -75.601,
// 72.976) and (32.297, 25.577, -34.836), so 41.274. The knee at 0.4 of it is at 16.510: 0.95 + 0.05 (25.1189 - 16.510)
// / (41.274 - 16.510) = 0.96738.
TEST(Flip, OfUniformPicturesIsTheRedistributedColourDifference) {
  EXPECT_NEAR(mean(uniform(0, 0, 0), uniform(255, 255, 255)), 0.96738, 2e-5);
  EXPECT_NEAR(mean(uniform(0, 255, 0), uniform(0, 0, 255)), 1, 1e-9);
  // sRGB 100 and 119 are L* 42.375 and 50.034: 7.659^0.7 = 4.1586, below the knee: 0.95 * 4.1586 / 16.510.
  EXPECT_NEAR(mean(uniform(100, 100, 100), uniform(119, 119, 119)), 0.23929, 2e-4);
}

TEST(Flip, GrowsWithNoise) {
  double before = 0;
  for (const double deviation : {2.0, 8.0, 32.0, 64.0}) {
    const double now = mean(picture(), noisy(picture(), deviation));
    EXPECT_GT(now, 1.2 * before) << deviation;
    before = now;
  }
}

TEST(Flip, MovesWithThePictures) {
  const Flip here = flip(picture(0), picture(2), kWidth, kHeight),
             there = flip(picture(4), picture(6), kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 10; x < 32; ++x) EXPECT_NEAR(here.pixels[y * kWidth + x], there.pixels[y * kWidth + x + 4], 1e-5f);
}

// Uniform sRGB 100 against a step from it to 119, luminances 0.12744 and 0.18447, at the first pixel of the step. The
// edge filter, whose halves sum to 1, answers with the step's height, 0.05704: the feature difference is
// (0.05704 / sqrt 2)^0.5 = 0.2008. The contrast filter's middle weight is 0.3859; it leaves 0.6929 of the step,
// so that the colours are 5.5002 in L* and 0.1898 apart.
TEST(Flip, OfAStepIsTheColourDifferenceRaisedByTheFeature) {
  Bytes step = uniform(100, 100, 100);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 24; x < kWidth; ++x) std::fill_n(&step[3 * (y * kWidth + x)], 3, std::uint8_t{119});
  const Flip f = flip(uniform(100, 100, 100), step, kWidth, kHeight);
  EXPECT_NEAR(f.pixels[16 * kWidth + 24], 0.26496, 1e-4);
  EXPECT_NEAR(f.pixels[16 * kWidth + 47], 0.23929, 2e-4);  // far from the step as of uniform pictures
}

}  // namespace
}  // namespace meniscal

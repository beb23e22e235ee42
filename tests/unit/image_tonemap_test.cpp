// Tone mapping against closed forms and at the limits of numbers.
#include <cmath>
#include <limits>

#include "gtest/gtest.h"
#include "host/image/tonemap.h"

namespace meniscal {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity(), kNan = std::numeric_limits<float>::quiet_NaN();
constexpr ToneMap kAll[] = {ToneMap::ward, ToneMap::aces, ToneMap::linear};

std::vector<float> grey(std::initializer_list<float> values) {
  std::vector<float> rgb;
  for (const float v : values) rgb.insert(rgb.end(), 3, v);
  return rgb;
}

// An eye adapted to half the display's maximum sees the scene as the display shows it: 1 / Ldmax, whatever the
// exponents.
TEST(ToneMap, WardLeavesTheDisplaysOwnLuminancesAlone) {
  EXPECT_NEAR(ward_scale(50, 100), 0.01, 1e-15);
  EXPECT_NEAR(ward_scale(40, 80), 1 / 80.0, 1e-15);
}

// Equation: ((1.219 + (Ldmax / 2)^0.4) / (1.219 + Lwa^0.4))^2.5 / Ldmax. 32^0.4 = 4, 1^0.4 = 1, 1024^0.4 = 16.
TEST(ToneMap, WardFollowsItsEquation) {
  EXPECT_NEAR(ward_scale(1, 64), std::pow(5.219 / 2.219, 2.5) / 64, 1e-12);
  EXPECT_NEAR(ward_scale(1024, 64), std::pow(5.219 / 17.219, 2.5) / 64, 1e-12);
  EXPECT_NEAR(ward_scale(0, 64), std::pow(5.219 / 1.219, 2.5) / 64, 1e-12);
  // Bright scenes: the display value of the adaptation luminance itself tends to (1.219 + (Ldmax / 2)^0.4)^2.5 / Ldmax.
  EXPECT_NEAR(ward_scale(1e20, 64) * 1e20, std::pow(5.219, 2.5) / 64, 1e-6);
}

TEST(ToneMap, WardsPixelsAreScaledByTheLogAverage) {
  // Luminances 10, 1000 and a black pixel that does not count: adapted to 100.
  const std::vector<std::uint8_t> bytes = tone_map(grey({10, 0, 1000}), ToneMap::ward, {});
  const double scale = ward_scale(100);
  EXPECT_EQ(bytes[0], std::lround(255 * srgb_encode(10 * scale)));
  EXPECT_EQ(bytes[3], 0);
  EXPECT_EQ(bytes[6], 255);
  EXPECT_GT(bytes[0], 20);
}

TEST(ToneMap, LogAverageWeighsByRec709AndLeavesOutWhatIsNoLuminance) {
  EXPECT_NEAR(log_average_luminance({1, 0, 0}), 0.2126, 1e-7);
  EXPECT_NEAR(log_average_luminance({0, 1, 0}), 0.7152, 1e-7);
  EXPECT_NEAR(log_average_luminance({0, 0, 1}), 0.0722, 1e-7);
  EXPECT_NEAR(log_average_luminance(grey({0.01f, 100, 0, -5, kNan, kInfinity, 1e-14f})), 1, 1e-6);
  EXPECT_EQ(log_average_luminance(grey({0, -1})), 0);
  EXPECT_EQ(log_average_luminance({}), 0);
}

TEST(ToneMap, SrgbEncodesAsTheStandardSays) {
  EXPECT_EQ(srgb_encode(0), 0);
  EXPECT_NEAR(srgb_encode(1), 1, 1e-12);
  EXPECT_NEAR(srgb_encode(0.001), 0.01292, 1e-12);
  EXPECT_NEAR(srgb_encode(0.5), 0.735356983, 1e-8);
  EXPECT_NEAR(srgb_encode(0.0031308), srgb_encode(0.0031309), 1e-5);  // the pieces meet
  EXPECT_EQ(srgb_encode(-1), 0);
  EXPECT_EQ(srgb_encode(std::nan("")), 0);
}

TEST(ToneMap, AcesFollowsItsFit) {
  EXPECT_EQ(aces_curve(0), 0);
  EXPECT_NEAR(aces_curve(0.18), 0.18 * (2.51 * 0.18 + 0.03) / (0.18 * (2.43 * 0.18 + 0.59) + 0.14), 1e-12);
  EXPECT_EQ(aces_curve(1e300), 1);
  for (double x = 0.01; x < 6; x += 0.01) EXPECT_GE(aces_curve(x + 0.01), aces_curve(x)) << x;
  // A uniform picture of any brightness is middle grey through the curve.
  const auto expected = std::lround(255 * srgb_encode(aces_curve(0.18)));
  EXPECT_EQ(tone_map(grey({3e-8f, 3e-8f}), ToneMap::aces, {})[0], expected);
  EXPECT_EQ(tone_map(grey({7e12f, 7e12f}), ToneMap::aces, {})[0], expected);
}

TEST(ToneMap, LinearPutsWhiteAtTheNinetyNinthPercentile) {
  std::vector<float> rgb;
  for (int i = 1; i <= 101; ++i) rgb.insert(rgb.end(), 3, static_cast<float>(i));
  const std::vector<std::uint8_t> bytes = tone_map(rgb, ToneMap::linear, {});
  EXPECT_EQ(bytes[3 * 99], 255);  // value 100 is white, the one above is clipped
  EXPECT_LT(bytes[3 * 98], 255);
  EXPECT_EQ(bytes[3 * 49], std::lround(255 * srgb_encode(0.5)));  // value 50
  EXPECT_EQ(tone_map(grey({0.25f}), ToneMap::linear, 0.0)[0],
            std::lround(255 * srgb_encode(0.25)));  // exposure given: no automatic
}

TEST(ToneMap, ExposureCountsInPowersOfTwo) {
  EXPECT_EQ(tone_map(grey({0.25f}), ToneMap::linear, 1.0)[0], std::lround(255 * srgb_encode(0.5)));
  const double ward = 2 * ward_scale(2);
  EXPECT_EQ(tone_map(grey({2}), ToneMap::ward, -2.0)[0], std::lround(255 * srgb_encode(ward / 4)));
  EXPECT_EQ(tone_map(grey({2}), ToneMap::aces, 1.0)[0], std::lround(255 * srgb_encode(aces_curve(0.36))));
}

TEST(ToneMap, SurvivesEveryNumber) {
  for (const ToneMap operation : kAll)
    for (const std::optional<double> exposure :
         {std::optional<double>(), std::optional<double>(0), std::optional<double>(-2000)}) {
      EXPECT_EQ(tone_map(grey({0, 0}), operation, exposure), std::vector<std::uint8_t>(6, 0));
      const std::vector<std::uint8_t> bytes = tone_map(grey({kNan, -kInfinity, -1, kInfinity}), operation, exposure);
      for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(bytes[i], 0);
      EXPECT_EQ(bytes[9], exposure.value_or(0) == 0 ? 255 : 0);
      for (const float unit : {1e-38f, 1e-20f, 1e20f, 1e38f}) {  // within a picture, brighter stays brighter
        const std::vector<std::uint8_t> ramp = tone_map(grey({0.1f * unit, 0.5f * unit, unit}), operation, exposure);
        EXPECT_LE(ramp[0], ramp[3]);
        EXPECT_LE(ramp[3], ramp[6]);
      }
    }
  for (const float unit : {1e-20f, 1.0f, 1e20f})  // these two adapt to any unit
    for (const ToneMap operation : {ToneMap::aces, ToneMap::linear})
      EXPECT_GT(tone_map(grey({unit}), operation, {})[0], 100);
}

}  // namespace
}  // namespace meniscal

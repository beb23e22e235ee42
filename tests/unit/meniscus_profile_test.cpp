// Equation (2) and the height rules against their closed forms.
#include <gtest/gtest.h>

#include "meniscus/profile.h"
#include "tests/unit/meniscus_shapes.h"

using namespace meniscus;

namespace {

double rise_at(HeightRule rule, double theta, double beta) {
  Liquid liquid = shapes::water({});
  liquid.height_rule = rule;
  return rise(liquid, glm::radians(theta), glm::radians(beta)) / liquid.capillary_length;
}

TEST(Profile, RiseFollowsPhiZeroInTheWettingRule) {
  EXPECT_NEAR(rise_at(HeightRule::wetting, 30, 90), 2 * 60 / 180.0, 1e-14);
  EXPECT_NEAR(rise_at(HeightRule::wetting, 90, 90), 0, 1e-14);
  EXPECT_NEAR(rise_at(HeightRule::wetting, 120, 90), -2 * 30 / 180.0, 1e-14);
  EXPECT_NEAR(rise_at(HeightRule::wetting, 30, 45), 2 * 15 / 180.0, 1e-14);
  EXPECT_NEAR(rise_at(HeightRule::wetting, 30, 135), 2 * 105 / 180.0, 1e-14);
}

TEST(Profile, RiseIsAsPrintedInTheOtherRule) {
  EXPECT_NEAR(rise_at(HeightRule::equation2, 30, 45), 2 * (1 - 30 / 180.0), 1e-14);
  EXPECT_NEAR(rise_at(HeightRule::equation2, 180, 90), 0, 1e-14);
}

TEST(Profile, ScalesAreFactors) {
  Liquid liquid = shapes::water({});
  const double height = rise(liquid, 0.5, 1.5), reach = sweep_length(liquid);
  EXPECT_DOUBLE_EQ(reach, 2 * shapes::kWater);
  liquid.height_scale = 3, liquid.sweep_scale = 0.5;
  EXPECT_DOUBLE_EQ(rise(liquid, 0.5, 1.5), 3 * height);
  EXPECT_DOUBLE_EQ(sweep_length(liquid), 0.5 * reach);
}

TEST(Profile, FallsFromOneToZeroWithItsDerivative) {
  EXPECT_EQ(profile(0), 1);
  EXPECT_EQ(profile(1), 0);
  EXPECT_EQ(profile(2), 0);
  EXPECT_EQ(profile_slope(1), 0);
  for (double d = 0.05; d < 1; d += 0.1) {
    EXPECT_NEAR(profile(d), 1 - std::sin(d * glm::half_pi<double>()), 1e-15);
    EXPECT_NEAR(profile_slope(d), (profile(d + 1e-6) - profile(d - 1e-6)) / 2e-6, 1e-8);
  }
}

}  // namespace

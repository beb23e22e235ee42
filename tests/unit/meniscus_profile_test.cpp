// Height rules and profiles against their closed forms.
#include <gtest/gtest.h>

#include <cmath>

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

constexpr Profile kProfiles[] = {Profile::sine, Profile::exponential, Profile::circular, Profile::bessel};

TEST(Profile, FallsFromOneToZeroWithItsDerivatives) {
  for (const Profile profile : kProfiles) {
    SCOPED_TRACE(static_cast<int>(profile));
    EXPECT_NEAR(falloff(profile, 0).height, 1, 1e-15);
    for (const double d : {1.0, 2.0}) {
      EXPECT_EQ(falloff(profile, d).height, 0);
      EXPECT_EQ(falloff(profile, d).slope, 0);
    }
    EXPECT_NEAR(falloff(profile, 1 - 1e-9).height, 0, 1e-15);
    EXPECT_NEAR(falloff(profile, 1 - 1e-9).slope, 0, 1e-8);
    for (double d = 0.05; d < 1; d += 0.1) {
      const Falloff before = falloff(profile, d - 1e-6), at = falloff(profile, d), after = falloff(profile, d + 1e-6);
      EXPECT_NEAR(at.slope, (after.height - before.height) / 2e-6, 1e-8) << d;
      EXPECT_NEAR(at.bend, (after.slope - before.slope) / 2e-6, 1e-7) << d;
      EXPECT_LT(at.slope, 0) << d;
      EXPECT_GT(at.bend, 0) << d;
    }
  }
}

TEST(Profile, HasItsClosedForm) {
  const double e2 = std::exp(-2.0);
  for (const double d : {0.01, 0.1, 0.3, 0.5, 0.8, 0.99}) {
    EXPECT_NEAR(falloff(Profile::sine, d).height, 1 - std::sin(d * glm::half_pi<double>()), 1e-15);
    // The circle of radius 1 about (1, 1).
    EXPECT_NEAR(glm::length(glm::dvec2(d - 1, falloff(Profile::circular, d).height - 1)), 1, 1e-15);
    EXPECT_NEAR(falloff(Profile::exponential, d).height, (std::exp(-2 * d) - e2 * (3 - 2 * d)) / (1 - 3 * e2), 1e-14);
    // K0 and K1 at 1 and 3 as tabulated.
    constexpr double k01 = 0.42102443824070833, k03 = 0.034739504386279248, k13 = 0.040156431128194184;
    EXPECT_NEAR(falloff(Profile::bessel, d).height,
                (std::cyl_bessel_k(0, 1 + 2 * d) - k03 + 2 * k13 * (d - 1)) / (k01 - k03 - 2 * k13), 1e-14);
  }
  EXPECT_NEAR(std::cyl_bessel_k(0, 2.0), 0.11389387274953344, 1e-15);
}

TEST(Profile, CircularStandsUprightAtTheWallWithFiniteNumbers) {
  const Falloff wall = falloff(Profile::circular, 0);
  EXPECT_LT(wall.slope, -7000);
  EXPECT_TRUE(std::isfinite(wall.slope) && std::isfinite(wall.bend));
}

TEST(Profile, DerivativesAreThoseOfTheHeight) {
  constexpr double kStep = 1e-5;
  for (const Profile profile : kProfiles) {
    for (double d = 0.05; d < 0.95; d += 0.1) {
      const Falloff before = falloff(profile, d - kStep), at = falloff(profile, d), after = falloff(profile, d + kStep);
      const auto expect = [&](double found, double low, double high) {
        EXPECT_NEAR(found, (high - low) / (2 * kStep), 1e-5 * std::abs(found) + 1e-6) << d;
      };
      expect(at.slope, before.height, after.height);
      expect(at.bend, before.slope, after.slope);
      expect(at.jerk, before.bend, after.bend);
    }
  }
}

}  // namespace

// Between its vertices, too, the surface is the one asked for, within the tolerance.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "meniscus/profile.h"
#include "meniscus/tolerance.h"
#include "tests/unit/meniscus_shapes.h"

using namespace shapes;
using glm::dvec3;
using meniscus::Profile;
using meniscus::Surface;

namespace {

constexpr Profile kProfiles[] = {Profile::sine, Profile::exponential, Profile::circular, Profile::bessel};

meniscus::Liquid liquid_for(double radius, Profile profile, double tolerance) {
  meniscus::Liquid liquid = water(sheet(12 * kMm + 2 * radius, 1));
  liquid.profile = profile, liquid.tolerance = tolerance;
  return liquid;
}

Surface round_post(double radius, Profile profile, double tolerance, double degrees = 30) {
  const int facets = radius < kMm ? 200 : radius < 10 * kMm ? 400 : 4096;
  return build(liquid_for(radius, profile, tolerance), {solid(post(radius, -50 * kMm, 10 * kMm, facets), degrees)});
}

// The largest error at random points of the menisci round a post at the origin, from `nearest` on, in sweep lengths.
meniscus::Error worst_error(const Surface& surface, double radius, Profile profile, double nearest) {
  constexpr double kSweep = 2 * kWater;
  const double rise = surface.contacts.at(0).rise_max;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  meniscus::Error worst;
  for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
    if (!surface.meniscus[t]) continue;
    const glm::uvec3& v = surface.mesh.triangles[t];
    for (int k = 0; k < 3; ++k) {
      double a = uniform(random), b = uniform(random);
      if (a + b > 1) a = 1 - a, b = 1 - b;
      const auto between = [&](const std::vector<dvec3>& values) {
        return (1 - a - b) * values[v.x] + a * values[v.y] + b * values[v.z];
      };
      const dvec3 p = between(surface.mesh.positions), n = glm::normalize(between(surface.mesh.normals));
      const double r = std::hypot(p.x, p.z), d = std::max(r - radius, 0.0) / kSweep;
      if (d < nearest) continue;
      const meniscus::Falloff fall = meniscus::falloff(profile, d);
      const double slope = rise / kSweep * fall.slope;
      const dvec3 exact = glm::normalize(dvec3(-slope * p.x / r, 1, -slope * p.z / r));
      worst.height = std::max(worst.height, std::abs(p.y - rise * fall.height) / std::sqrt(1 + slope * slope));
      worst.normal = std::max(worst.normal, glm::length(glm::cross(n, exact)));
    }
  }
  return worst;
}

class Tolerance : public testing::TestWithParam<std::tuple<double, Profile>> {};

TEST_P(Tolerance, HoldsBetweenTheVertices) {
  const auto [radius, profile] = GetParam();
  // The circular profile stands upright at the wall: there the layers are as near as they may be.
  const double nearest = profile == Profile::circular ? 0.08 : 0;
  std::size_t before = 0;
  for (const double factor : {8.0, 1.0, 0.25}) {
    SCOPED_TRACE(factor);
    const Surface surface = round_post(radius, profile, factor);
    const meniscus::Error worst = worst_error(surface, radius, profile, nearest);
    const meniscus::Error allowed =
        tolerance_for(liquid_for(radius, profile, factor), glm::two_pi<double>() * radius, true);
    EXPECT_LT(worst.height, allowed.height);
    EXPECT_LT(worst.normal, allowed.normal);
    EXPECT_GT(std::max(worst.height / allowed.height, worst.normal / allowed.normal), 0.15) << "finer than needed";
    EXPECT_GT(surface.contacts[0].triangles, 2 * before);
    before = surface.contacts[0].triangles;
  }
}

INSTANTIATE_TEST_SUITE_P(Posts, Tolerance,
                         testing::Combine(testing::Values(0.2 * kMm, 2 * kMm, 20 * kMm), testing::ValuesIn(kProfiles)));

TEST(ToleranceOf, TheUsualPostIsThatOfThePaper) {
  const Surface surface = round_post(2 * kMm, Profile::sine, 1);
  EXPECT_NEAR(static_cast<double>(surface.contacts[0].triangles), 2 * 128 * 72, 600);
}

TEST(ToleranceOf, LowMenisciTakeFewTriangles) {
  const auto triangles = [](double degrees) {
    return round_post(2 * kMm, Profile::sine, 1, degrees).contacts[0].triangles;
  };
  EXPECT_LT(triangles(60), 0.8 * static_cast<double>(triangles(30)));
  EXPECT_LT(triangles(85), 0.6 * static_cast<double>(triangles(60)));
  EXPECT_GT(triangles(85), 300u);
}

TEST(ToleranceOf, ScalesWithTheScene) {
  for (const double scale : {1e-3, 1e3}) {
    meniscus::Liquid liquid = liquid_for(2 * kMm, Profile::sine, 1);
    liquid.mesh = scaled(liquid.mesh, scale), liquid.capillary_length *= scale;
    const Surface surface = build(liquid, {solid(scaled(post(2 * kMm, -50 * kMm, 10 * kMm, 1024), scale), 30)});
    EXPECT_EQ(surface.contacts[0].triangles, round_post(2 * kMm, Profile::sine, 1).contacts[0].triangles);
  }
}

}  // namespace

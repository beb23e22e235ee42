// Liquids that are not level: menisci rise along the sheet's own normals.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/meniscus/surface.h"

using namespace shapes;
using namespace surfaces;
using glm::dvec3;
using meniscus::Surface;

namespace {

// What stands perpendicular on the tilted sheet stands upright when both are turned back. The contact line is then that
// of the level liquid, and heights along the sheet's normal follow the height function; but distances are measured as
// seen from above, so that along the slope the meniscus reaches 1 / cos(tilt) as far.
TEST(Slope, PerpendicularPostHasTheLevelPostsContactLineAndHeightsAlongTheNormal) {
  const double tilt = 20;
  const dvec3 axis = glm::normalize(dvec3(1, 0, 0.4));
  for (const double theta : {30.0, 120.0}) {
    const Surface surface = build(water(turned(sheet(30 * kMm, 1), tilt, axis)),
                                  {solid(turned(post(2 * kMm, -50 * kMm, 30 * kMm, 256), tilt, axis), theta)});
    EXPECT_TRUE(surface.warnings.empty());
    ASSERT_EQ(surface.contacts.size(), 1u);
    const double h0 = kSweep * (90 - theta) / 180;
    EXPECT_NEAR(surface.contacts[0].rise_min, h0, 1e-6 * kWater);
    EXPECT_NEAR(surface.contacts[0].rise_max, h0, 1e-6 * kWater);
    const dvec3 uphill = glm::cross(axis, dvec3(0, 1, 0));
    double worst = 0;
    std::size_t raised = 0, at_wall = 0;
    const TriangleMesh back = turned(surface.mesh, -tilt, axis);
    for (const dvec3& p : back.positions) {
      const double r = std::hypot(p.x, p.z), along_slope = r > 0 ? (uphill.x * p.x + uphill.z * p.z) / r : 0;
      const double seen = std::sqrt(1 - std::pow(along_slope * std::sin(glm::radians(tilt)), 2));
      const double d = std::max(r - 2 * kMm, 0.0) / kSweep * seen;
      worst = std::max(worst, std::abs(p.y - (d < 1 ? h0 * (1 - std::sin(glm::half_pi<double>() * d)) : 0)));
      raised += d < 1;
      if (r < 2 * kMm + 1e-9) {
        ++at_wall;
        EXPECT_NEAR(p.y, h0, 1e-6 * kWater);
      }
    }
    EXPECT_LT(worst, 1e-4 * kWater) << theta;  // seen from above an ellipse, on which feet are interpolated
    EXPECT_GT(raised, 5000u);
    EXPECT_GE(at_wall, 128u);
  }
}

// A wall across waves that run along it stands perpendicular on them everywhere: each point of the liquid rises by the
// height function along the normal that the waves have there. Beside that it may move along the wall, in which the
// contact line keeps to the solid's axis, but not away from it.
TEST(Slope, WavesAlongAWallRiseByTheirNormals) {
  const double height = 0.4 * kMm, k = 1 / (3 * kMm);
  const auto waves = [=](double, double z) { return height * std::sin(k * z); };
  meniscus::Liquid liquid = water(sheet(15 * kMm, 150, waves));
  const std::vector<meniscus::Solid> wall{
      solid(box({-20 * kMm, -9 * kMm, -20 * kMm}, {-5 * kMm, 9 * kMm, 20 * kMm}), 30)};
  const Surface raised = build(liquid, wall);
  liquid.flatten = true;  // the same mesh, left where it was
  const Surface level = build(liquid, wall);
  ASSERT_EQ(raised.mesh.positions.size(), level.mesh.positions.size());
  ASSERT_EQ(raised.mesh.triangles, level.mesh.triangles);
  const double h0 = kSweep * 60 / 180;
  double steepest = 0;
  for (std::size_t i = 0; i < level.mesh.positions.size(); ++i) {
    const dvec3 base = level.mesh.positions[i];
    const dvec3 normal = glm::normalize(dvec3(0, 1, -height * k * std::cos(k * base.z)));
    const double d = (base.x + 5 * kMm) / kSweep;
    const double h = d < 1 ? h0 * (1 - std::sin(glm::half_pi<double>() * d)) : 0;
    const dvec3 way = raised.mesh.positions[i] - base;
    EXPECT_NEAR(glm::dot(way, normal), h, 1e-3 * h0) << base.x << " " << base.z;
    EXPECT_NEAR(way.x, 0, 1e-9 * h0);
    if (h > 0.5 * h0) steepest = std::max(steepest, std::abs(normal.z));
  }
  EXPECT_GT(steepest, 0.12);
}

}  // namespace

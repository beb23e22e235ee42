// What must hold of the exact meniscus whatever its shape: convergence, repetition, place, edges and neighbours.
#include <algorithm>

#include "meniscus/young_laplace.h"
#include "tests/unit/meniscus_solved.h"

using namespace solved;
using glm::dvec2;
using glm::dvec3;

namespace {

// A tolerance 4 times as strict halves the mesh.
TEST(Solved, HeightsConvergeWithTheMesh) {
  for (const double theta : {30.0, 120.0}) {
    const double exact = meniscus::exact_rise(glm::radians(90 - theta), 1) * kWater;
    const auto error = [&](double tolerance) {
      const meniscus::Surface surface = solve_post(kWater, theta, tolerance);
      const meniscus::Contact& contact = surface.contacts.at(0);
      return std::max(std::abs(contact.rise_min / exact - 1), std::abs(contact.rise_max / exact - 1));
    };
    const double coarse = error(16), middle = error(4), fine = error(1);
    EXPECT_LT(middle, coarse / 3) << theta;
    EXPECT_LT(fine, middle / 3) << theta;
  }
}

TEST(Solved, MenisciAreTheSameBitsTwice) {
  const auto once = [] { return solve_post(2 * kMm, 30); };
  const meniscus::Surface a = once(), b = once();
  EXPECT_EQ(a.mesh.positions, b.mesh.positions);
  EXPECT_EQ(a.mesh.normals, b.mesh.normals);
  EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
  EXPECT_EQ(a.meniscus, b.meniscus);
}

TEST(Solved, HeightsAreTheSameWhereverTheSceneIsTurned) {
  const TriangleMesh one = post(2 * kMm, -20 * kMm, 20 * kMm, 256);
  const auto rises = [&](double degrees) {
    const auto place = [&](const TriangleMesh& mesh) { return turned(mesh, degrees, {0, 1, 0}); };
    const meniscus::Surface surface =
        solve(still_water(place(sheet(40 * kMm, 40))),
              {solid(place(translated(one, {-2.5 * kMm, 0, 0})), 30, "left"),
               solid(place(turned(translated(one, {3 * kMm, 0, 0}), 10, {1, 0, 0})), 120, "right")});
    std::vector<double> result;
    for (const meniscus::Contact& c : surface.contacts) result.push_back(c.rise_min), result.push_back(c.rise_max);
    return result;
  };
  const std::vector<double> straight = rises(0), askew = rises(37);
  ASSERT_EQ(straight.size(), 4u);
  ASSERT_EQ(askew.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(askew[i] / straight[i], 1, 1e-4) << i;
}

TEST(Solved, NothingIsBuiltWhereTheLiquidMeetsItsSolidLevel) {
  const meniscus::Surface surface =
      build(still_water(around(2 * kMm)), {solid(post(2 * kMm, -20 * kMm, 20 * kMm, 256), 90)});
  EXPECT_EQ(surface.solution.parts, 0u);
  EXPECT_EQ(surface.solution.unknowns, 0u);
  EXPECT_EQ(std::count(surface.meniscus.begin(), surface.meniscus.end(), 1), 0);
  for (const dvec3& p : surface.mesh.positions) ASSERT_EQ(p.y, 0);
}

// Round it the wall's own meniscus, of height h0 exp(-x / L) there as good as, leans but keeps its mean height.
TEST(Solved, AWettingWallLiftsTheLiquidRoundALevelPostBesideIt) {
  const double radius = 0.5 * kMm, to_wall = 3 * kMm;
  const TriangleMesh wall = box({-to_wall - 10 * kMm, -20 * kMm, -21 * kMm}, {-to_wall, 20 * kMm, 21 * kMm});
  const meniscus::Surface surface =
      solve(still_water(translated(rectangle(18 * kMm, 20 * kMm, 40), {10 * kMm, 0, 0})),
            {solid(wall, 60, "wall"), solid(post(radius, -20 * kMm, 20 * kMm, 256), 90, "post")});
  ASSERT_EQ(surface.contacts.size(), 2u);
  const meniscus::Contact& lifted = surface.contacts[surface.contacts[0].solid == "post" ? 0 : 1];
  const double alone = 2 * std::sin(glm::radians(15.0)) * kWater * std::exp(-to_wall / kWater);
  EXPECT_NEAR(0.5 * (lifted.rise_min + lifted.rise_max) / alone, 1, 0.15);
  EXPECT_GT(lifted.rise_max, 1.2 * lifted.rise_min);
}

TEST(Solved, APostInAWavyLiquidRaisesItAsALevelOne) {
  const double radius = 2 * kMm;
  const auto solve_in = [&](const std::function<double(double, double)>& height) {
    const meniscus::Surface surface =
        solve(still_water(sheet(40 * kMm, 80, height)), {solid(post(radius, -20 * kMm, 20 * kMm, 256), 30)});
    std::vector<double> rises;
    for (const dvec3& p : surface.mesh.positions)
      if (std::abs(std::hypot(p.x, p.z) / radius - 1) < 1e-3) rises.push_back(p.y - height(p.x, p.z));
    EXPECT_GT(rises.size(), 60u);
    const auto [low, high] = std::minmax_element(rises.begin(), rises.end());
    return dvec2(*low, *high);
  };
  const auto level = solve_in([](double, double) { return 0.0; });
  const auto wavy =
      solve_in([](double x, double) { return 2 * kMm * std::sin(2 * glm::pi<double>() * x / (80 * kMm)); });
  EXPECT_NEAR(wavy.x / level.x, 1, 0.02);
  EXPECT_NEAR(wavy.y / level.y, 1, 0.02);
}

TEST(Solved, AContactLineIsPinnedAtTheRimOfAShortPost) {
  const double top = 1 * kMm;
  const meniscus::Surface surface =
      solve(still_water(around(2 * kMm), 16), {solid(post(2 * kMm, -20 * kMm, top, 256), 0)});
  ASSERT_EQ(surface.contacts.size(), 1u);
  EXPECT_LE(surface.contacts[0].rise_max, top);
  EXPECT_GE(surface.contacts[0].rise_min, 0.98 * top);
  EXPECT_TRUE(std::any_of(surface.warnings.begin(), surface.warnings.end(),
                          [](const std::string& warning) { return warning.find("pinned") != std::string::npos; }));
}

}  // namespace

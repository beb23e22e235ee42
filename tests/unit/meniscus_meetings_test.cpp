// Where liquid and solids meet otherwise than in one closed line: several, at borders, exactly in faces or points.
#include <gtest/gtest.h>

#include <algorithm>

#include "meniscus/check.h"
#include "tests/support/meniscus/surface.h"

using namespace shapes;
using namespace surfaces;
using glm::dvec3;
using meniscus::Report;
using meniscus::Surface;

namespace {

TEST(Build, TwoPostsShareTheLiquidBetweenThem) {
  const dvec3 at[2] = {{-3.5 * kMm, 0, 0}, {3.5 * kMm, 0, 0}};
  const Surface surface = build(water(sheet(30 * kMm, 1)), {solid(translated(tall_post(), at[0]), 30, "left"),
                                                            solid(translated(tall_post(), at[1]), 30, "right")});
  EXPECT_EQ(expect_sound(surface).boundary_loops, 3u);
  EXPECT_EQ(surface.contacts.size(), 2u);
  EXPECT_TRUE(surface.warnings.empty());
  const double h0 = kSweep * 60 / 180;
  std::size_t shared = 0;
  for (const dvec3& p : surface.mesh.positions) {
    double d[2];
    for (int k = 0; k < 2; ++k) d[k] = std::max(std::hypot(p.x - at[k].x, p.z) - 2 * kMm, 0.0) / kSweep;
    const double least = std::min(d[0], d[1]);
    EXPECT_NEAR(p.y, least < 1 ? h0 * (1 - std::sin(glm::half_pi<double>() * least)) : 0, 1e-6 * kMm);
    shared += d[0] < 1 && d[1] < 1;
  }
  EXPECT_GT(shared, 100u);
}

TEST(Build, OverlappingSolidsRemoveTheirUnion) {
  const auto a = translated(tall_post(128), {-1.5 * kMm, 0, 0}), b = translated(tall_post(128), {1.5 * kMm, 0, 0});
  const Surface surface = build(water(sheet(30 * kMm, 1)), {solid(a, 30, "left"), solid(b, 30, "right")});
  EXPECT_EQ(expect_sound(surface).boundary_loops, 2u);
  const double circle = 0.5 * 128 * 4 * kMm * kMm * std::sin(2 * glm::pi<double>() / 128);
  const double lens = (2 * 4 * std::acos(1.5 / 2) - 3 * std::sqrt(4 - 1.5 * 1.5)) * kMm * kMm;
  EXPECT_NEAR(plan_area(surface, false), 3600 * kMm * kMm - (2 * circle - lens), 0.01 * kMm * kMm);
}

TEST(Build, OpenContourAtTheLiquidsBorder) {
  const auto at_border = translated(tall_post(128), {29 * kMm, 0, 3 * kMm});
  const Surface surface = build(water(sheet(30 * kMm, 1)), {solid(at_border, 30)});
  EXPECT_EQ(expect_sound(surface).boundary_loops, 1u);
  ASSERT_EQ(surface.contacts.size(), 1u);
  EXPECT_FALSE(surface.contacts[0].closed);
}

TEST(Build, ClosedLiquidStaysClosedButForTheContact) {
  const Surface surface =
      build(water(box({-30 * kMm, -60 * kMm, -30 * kMm}, {30 * kMm, 0, 30 * kMm})), {solid(tall_post(), 30)});
  const Report report = expect_sound(surface);
  EXPECT_EQ(report.boundary_loops, 1u);
  EXPECT_TRUE(surface.warnings.empty());
  const auto at_border = translated(tall_post(128), {29 * kMm, 0, 3 * kMm});
  const Surface divided =
      build(water(box({-30 * kMm, -60 * kMm, -30 * kMm}, {30 * kMm, 0, 30 * kMm})), {solid(at_border, 30)});
  EXPECT_EQ(expect_sound(divided, 0).boundary_loops, 1u);
  EXPECT_TRUE(divided.warnings.empty());
}

TEST(Build, DegenerateMeetings) {
  const auto slab = [](double bottom, double top) {
    return box({-5 * kMm, bottom, -4 * kMm}, {5 * kMm, top, 4 * kMm});
  };
  // A face exactly at the level wets, whether the solid hangs below it or stands on it.
  for (const auto& mesh : {slab(-5 * kMm, 0), slab(0, 5 * kMm)}) {
    const Surface surface = build(water(sheet(30 * kMm, 4)), {solid(mesh, 90, "slab")});
    EXPECT_EQ(expect_sound(surface).boundary_loops, 2u);
    ASSERT_FALSE(surface.warnings.empty());
    EXPECT_NE(surface.warnings[0].find("'slab'"), std::string::npos);
  }
  // Below or above: no contact, the liquid as it was.
  for (const auto& mesh : {slab(-5 * kMm, -1 * kMm), slab(1 * kMm, 5 * kMm)}) {
    const TriangleMesh liquid = sheet(30 * kMm, 4);
    const Surface surface = build(water(liquid), {solid(mesh, 30)});
    EXPECT_TRUE(surface.contacts.empty());
    EXPECT_EQ(surface.mesh.triangles.size(), liquid.triangles.size());
    EXPECT_EQ(surface.mesh.positions.size(), liquid.positions.size());
  }
  // An open sheet of a solid parts nothing.
  TriangleMesh plate;
  add_triangle(plate, {-1 * kMm, -5 * kMm, 0}, {1 * kMm, -5 * kMm, 0}, {0, 5 * kMm, 0}, {0, 0, 1});
  const Surface surface = build(water(sheet(30 * kMm, 4)), {solid(plate, 30, "plate")});
  EXPECT_TRUE(surface.contacts.empty());
  ASSERT_EQ(surface.warnings.size(), 1u);
  EXPECT_NE(surface.warnings[0].find("'plate'"), std::string::npos);
}

TEST(Build, SolidRunsExactlyThroughTheLiquidsPoints) {
  // Corners, edges and faces of the solid run exactly through points and edges of the liquid's grid.
  const Surface surface =
      build(water(sheet(8 * kMm, 8)), {solid(box({-2 * kMm, -4 * kMm, -2 * kMm}, {2 * kMm, 4 * kMm, 2 * kMm}), 90)});
  EXPECT_EQ(expect_sound(surface).boundary_loops, 2u);
  EXPECT_NEAR(plan_area(surface, false), (256 - 16) * kMm * kMm, 1e-15);
}

TEST(Build, ContainerKeepsTheLiquidWithinIt) {
  // The square sheet reaches into the round wall; what lies in the wall goes, the meniscus climbs the inner side.
  const TriangleMesh dish = cup(8 * kMm, 12 * kMm, -10 * kMm, 8 * kMm);
  const Surface surface = build(water(sheet(8.3 * kMm, 16)), {solid(dish, 30, "dish")});
  EXPECT_EQ(expect_sound(surface).boundary_loops, 1u);
  EXPECT_TRUE(surface.warnings.empty());
  expect_contact_on(dish, surface, meniscus::inspect(surface.mesh), 20 * kMm);
  EXPECT_NEAR(plan_area(surface, false), 0.5 * 96 * std::sin(2 * glm::pi<double>() / 96) * 64 * kMm * kMm,
              1e-9);  // joints of 96 facets are kept, but for merged points
  for (const dvec3& p : surface.mesh.positions) {
    const double d = std::max(8 * kMm - std::hypot(p.x, p.z), 0.0) / kSweep;
    EXPECT_NEAR(p.y, d < 1 ? kSweep * 60 / 180 * (1 - std::sin(glm::half_pi<double>() * d)) : 0, 0.01 * kMm);
  }
}

// What counts as short of a wall is less of a small vessel, whose wall may be thin, and of one in low gravity.
TEST(Build, BordersAreMovedByLittleOfTheLiquidsSize) {
  TriangleMesh disc;
  for (int i = 0; i < 96; ++i) {
    const auto at = [](int k) {
      const double a = k % 96 == 0 ? 0 : 2 * glm::pi<double>() * k / 96;
      return 0.25 * kMm * dvec3(std::sin(a), 0, std::cos(a));
    };
    add_triangle(disc, dvec3(0), at(i), at(i + 1), {0, 1, 0});
  }
  const TriangleMesh tube = cup(0.25 * kMm, 0.28 * kMm, -10 * kMm, 10 * kMm);
  const Surface surface = build(water(disc), {solid(tube, 60, "tube")});
  ASSERT_EQ(surface.contacts.size(), 1u);
  EXPECT_NEAR(surface.contacts[0].length, 2 * glm::pi<double>() * 0.25 * kMm, 0.01 * kMm);
  for (const dvec3& p : surface.mesh.positions) EXPECT_LT(std::hypot(p.x, p.z), 0.2501 * kMm);

  meniscus::Liquid floating = water(sheet(30 * kMm, 1));
  floating.capillary_length = 1e3;
  for (const dvec3& p : build(floating, {solid(tall_post(64), 30)}).mesh.positions)
    EXPECT_LT(std::max(std::abs(p.x), std::abs(p.z)), 31 * kMm);
}

TEST(Build, LiquidWithinASolidIsGoneWithAWarning) {
  const meniscus::Solid full = solid(post(8 * kMm, -5 * kMm, 5 * kMm, 32), 30);
  for (const TriangleMesh& mesh : {sheet(1 * kMm, 2), box({-kMm, -kMm, -kMm}, {kMm, 0, kMm})}) {
    const Surface surface = build(water(mesh), {full});
    ASSERT_EQ(surface.warnings.size(), 1u);
    EXPECT_NE(surface.warnings[0].find("liquid 'water' lies wholly within solids"), std::string::npos);
    EXPECT_EQ(plan_area(surface, true), 0);
  }
  EXPECT_TRUE(build(water(sheet(1 * kMm, 2)), {full}).mesh.triangles.empty());
}

TEST(Build, RingLyingInTheSurfaceHasTwoContours) {
  const Surface surface = build(water(sheet(30 * kMm, 1)), {solid(torus(8 * kMm, 3 * kMm, 96, 48), 60)});
  const Report report = expect_sound(surface);
  EXPECT_EQ(surface.contacts.size(), 2u);
  EXPECT_EQ(report.components, 2u);
  EXPECT_EQ(report.boundary_loops, 3u);
}

// What the liquid parts from nothing is no contact: a point, an edge, a sheet with two sides in one place.
TEST(Build, TouchingSolidsGetNoMeniscus) {
  TriangleMesh plate = tall_post(64);
  for (dvec3& p : plate.positions) p.x = 0;
  const dvec3 up(0, 1, 0);
  const std::pair<const char*, TriangleMesh> cases[] = {
      {"point below", translated(sphere(4 * kMm, 64, 32), -4 * kMm * up)},
      {"edge below",
       translated(turned(box({-kMm, -kMm, -kMm}, {kMm, kMm, kMm}), 45, {1, 0, 0}), -std::sqrt(2.0) * kMm * up)},
      {"plate", plate}};
  for (const auto& [name, mesh] : cases) {
    SCOPED_TRACE(name);
    const Surface surface = build(water(sheet(30 * kMm, 2)), {solid(mesh, 30, "it")});
    EXPECT_TRUE(surface.contacts.empty());
    EXPECT_EQ(surface.mesh.triangles.size(), 8u);
    ASSERT_EQ(surface.warnings.size(), 1u);
    EXPECT_NE(surface.warnings[0].find("'it' has no thickness where it meets the liquid"), std::string::npos);
  }
  // From above there is no contour at all.
  const Surface surface =
      build(water(sheet(30 * kMm, 2)), {solid(translated(sphere(4 * kMm, 64, 32), 4 * kMm * up), 30)});
  EXPECT_TRUE(surface.contacts.empty());
  EXPECT_TRUE(surface.warnings.empty());
}

// A sphere dipping in by a micrometre wets only beneath: at its height the meniscus would cut into the sphere, so it is
// lowered to the level, and says so.
TEST(Build, ContactsSayHowFarTheyRiseInFact) {
  const TriangleMesh dipping = translated(sphere(4 * kMm, 64, 32), {0, 3.999 * kMm, 0});
  const Surface surface = build(water(sheet(30 * kMm, 2)), {solid(dipping, 30)});
  double highest = 0;
  for (const dvec3& p : surface.mesh.positions) highest = std::max(highest, p.y);
  ASSERT_EQ(surface.contacts.size(), 1u);
  EXPECT_EQ(surface.contacts[0].warnings.size(), 1u);
  EXPECT_NEAR(surface.contacts[0].rise_max, highest, 1e-6 * kWater);
}

}  // namespace

// Menisci of one solid: what the surface must be, by closed form or by topology.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "tests/support/meniscus/surface.h"

using namespace shapes;
using namespace surfaces;
using glm::dvec3;
using meniscus::Report;
using meniscus::Surface;

namespace {

TEST(Build, PostHasThePapersProfileAndItsNormals) {
  for (const double theta : {30.0, 60.0, 120.0}) {
    const Surface surface = build(water(sheet(30 * kMm, 1)), {solid(tall_post(), theta)});
    const Report report = expect_sound(surface, 10);
    EXPECT_EQ(report.components, 1u);
    EXPECT_EQ(report.boundary_loops, 2u);
    EXPECT_TRUE(surface.warnings.empty());
    EXPECT_LT(surface.mesh.triangles.size(), 60000u);
    ASSERT_EQ(surface.contacts.size(), 1u);
    const double h0 = kSweep * (90 - theta) / 180;
    EXPECT_NEAR(surface.contacts[0].rise_min, h0, 1e-12);
    EXPECT_NEAR(surface.contacts[0].rise_max, h0, 1e-12);
    std::set<double> layers;
    for (std::size_t i = 0; i < surface.mesh.positions.size(); ++i) {
      const dvec3 p = surface.mesh.positions[i];
      const double r = std::hypot(p.x, p.z), d = std::max(r - 2 * kMm, 0.0) / kSweep;
      const bool inside = d < 1;
      const double h = inside ? h0 * (1 - std::sin(glm::half_pi<double>() * d)) : 0;
      const double slope = inside ? -h0 * glm::half_pi<double>() / kSweep * std::cos(glm::half_pi<double>() * d) : 0;
      EXPECT_NEAR(p.y, h, 1e-12);
      const dvec3 n = r > 0 ? glm::normalize(dvec3(-slope * p.x / r, 1, -slope * p.z / r)) : dvec3(0, 1, 0);
      EXPECT_LT(glm::distance(surface.mesh.normals[i], n), 1e-9) << "at " << d;
      if (inside) layers.insert(std::round(d * 1e6));
    }
    EXPECT_NEAR(static_cast<double>(layers.size()), 73 * std::sqrt(std::abs(90 - theta) / 60), 6);
  }
}

TEST(Build, CoarsePostOnACoarseSheetGetsFineColumns) {
  const Surface surface = build(water(sheet(30 * kMm, 1)), {solid(tall_post(32), 30)});
  const Report report = expect_sound(surface, 10);
  EXPECT_GE(contact_vertices(surface, report, 30 * kMm).size(), 128u);
  expect_contact_on(tall_post(32), surface, report);
}

TEST(Build, FinelyFacetedFlatShadedPostCountsAsRound) {
  std::vector<glm::dvec2> polygon;
  for (int i = 0; i < 200; ++i) {
    const double a = 2 * glm::pi<double>() * i / 200;
    polygon.emplace_back(2 * kMm * std::cos(a), 2 * kMm * std::sin(a));
  }
  const Surface surface = build(water(sheet(30 * kMm, 1)), {solid(prism(polygon, -50 * kMm, 10 * kMm), 30)});
  EXPECT_EQ(expect_sound(surface).boundary_loops, 2u);
  EXPECT_LT(surface.mesh.triangles.size(), 60000u);
  double worst = 0;  // how far a normal leaves its radial plane
  for (std::size_t i = 0; i < surface.mesh.positions.size(); ++i) {
    const dvec3 p = surface.mesh.positions[i], n = surface.mesh.normals[i];
    if (const double r = std::hypot(p.x, p.z); r > 0) worst = std::max(worst, std::abs(n.x * p.z - n.z * p.x) / r);
  }
  EXPECT_LT(worst, 1e-3);
}

TEST(Build, AreaRemovedIsTheSolidsSectionAndTheBandIsARing) {
  const Surface surface = build(water(sheet(30 * kMm, 1)), {solid(tall_post(128), 30)});
  const double section = 0.5 * 128 * 4 * kMm * kMm * std::sin(2 * glm::pi<double>() / 128);
  EXPECT_NEAR(plan_area(surface, false), 3600 * kMm * kMm - section, 1e-12);
  const double outer = 2 * kMm + kSweep;
  EXPECT_NEAR(plan_area(surface, true), 0.5 * 128 * std::sin(2 * glm::pi<double>() / 128) * outer * outer - section,
              1e-9);
}

// What is within fills the holes: an edge that has but one triangle lies on the sheet's own border.
TEST(Build, WithinSolidsTheSurfaceGoesOnWithoutAGap) {
  const TriangleMesh tilted = turned(post(2 * kMm, -50 * kMm, 40 * kMm, 128), 45, {0, 0, -1});
  for (const auto& [rod, cells] :
       {std::pair(tall_post(128), 1), std::pair(tilted, 1), std::pair(post(12 * kMm, -50 * kMm, 10 * kMm, 64), 60)}) {
    const Surface surface = build(water(sheet(30 * kMm, cells)), {solid(rod, 30)});
    ASSERT_FALSE(surface.within.triangles.empty());
    using Point = std::tuple<double, double, double>;
    std::set<std::pair<Point, Point>> edges;
    for (const TriangleMesh* mesh : {&surface.mesh, &surface.within})
      for (const glm::uvec3& t : mesh->triangles)
        for (int i = 0; i < 3; ++i) {
          const dvec3 a = mesh->positions[t[i]], b = mesh->positions[t[(i + 1) % 3]];
          EXPECT_TRUE(edges.emplace(Point(a.x, a.y, a.z), Point(b.x, b.y, b.z)).second);
        }
    std::size_t open = 0;
    for (const auto& [a, b] : edges) {
      if (edges.contains({b, a})) continue;
      const double from_border =
          std::max(std::abs(std::get<0>(a) + std::get<0>(b)), std::abs(std::get<2>(a) + std::get<2>(b)));
      if (from_border < 2 * 29.999 * kMm) ++open;
    }
    EXPECT_EQ(open, 0u);
  }
}

TEST(Build, NinetyDegreesLeavesOnlyTheHole) {
  const Surface surface = build(water(sheet(30 * kMm, 1)), {solid(tall_post(), 90)});
  EXPECT_EQ(expect_sound(surface).boundary_loops, 2u);
  EXPECT_EQ(std::count(surface.meniscus.begin(), surface.meniscus.end(), 1), 0);
  for (const dvec3& p : surface.mesh.positions) EXPECT_EQ(p.y, 0);
  ASSERT_EQ(surface.contacts.size(), 1u);
  EXPECT_NEAR(surface.contacts[0].rise_max, 0, 1e-14);
}

TEST(Build, TiltedRodIsBondedAndItsNormalsAreThoseOfItsShape) {
  const TriangleMesh rod = turned(post(2 * kMm, -50 * kMm, 40 * kMm, 128), 45, {0, 0, -1});
  const Surface surface = build(water(sheet(30 * kMm, 1)), {solid(rod, 30)});
  const Report report = expect_sound(surface);
  EXPECT_EQ(report.boundary_loops, 2u);
  expect_contact_on(rod, surface, report);
  ASSERT_EQ(surface.contacts.size(), 1u);
  EXPECT_NEAR(surface.contacts[0].rise_min, kSweep * 15 / 180, 1e-6);
  EXPECT_NEAR(surface.contacts[0].rise_max, kSweep * 105 / 180, 1e-6);
  // Vertex normals against area-weighted normals of the facets, away from the borders of the band.
  const TriangleMesh& mesh = surface.mesh;
  std::vector<dvec3> sum(mesh.positions.size(), dvec3(0));
  std::vector<bool> inner(mesh.positions.size(), true);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const glm::uvec3& v = mesh.triangles[t];
    for (int i = 0; i < 3; ++i) {
      sum[v[i]] += glm::cross(mesh.positions[v.y] - mesh.positions[v.x], mesh.positions[v.z] - mesh.positions[v.x]);
      if (!surface.meniscus[t]) inner[v[i]] = false;
    }
  }
  for (const auto& [a, b] : report.boundary) inner[a] = inner[b] = false;
  double worst = 0;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    if (inner[i]) worst = std::max(worst, glm::distance(mesh.normals[i], glm::normalize(sum[i])));
  }
  EXPECT_LT(worst, 0.06);
}

TEST(Build, SphereAndConeAndBoxes) {
  const TriangleMesh block = box({-5 * kMm, -10 * kMm, -4 * kMm}, {5 * kMm, 10 * kMm, 4 * kMm});
  const std::pair<const char*, TriangleMesh> cases[] = {
      {"sphere, its equator exactly at the level", sphere(4 * kMm, 64, 32)},
      {"sphere, high", translated(sphere(4 * kMm, 64, 32), {0.3 * kMm, 1.3 * kMm, 0})},
      {"sphere, low", translated(sphere(4 * kMm, 64, 32), {0, -1.5 * kMm, 0.1 * kMm})},
      {"cone", revolve([](double y) { return (20 * kMm - y) * 0.3; }, -20 * kMm, 19.9 * kMm, 64, 8)},
      {"box", block},
      {"box turned by 30 degrees", turned(block, 30, {0, 1, 0})},
      {"box on its side", turned(turned(block, 20, {1, 0, 0}), 25, {0, 0, 1})},
  };
  for (const auto& [name, mesh] : cases) {
    SCOPED_TRACE(name);
    const Surface surface = build(water(sheet(30 * kMm, 1)), {solid(mesh, 60)});
    const Report report = expect_sound(surface);
    EXPECT_EQ(report.components, 1u);
    EXPECT_EQ(report.boundary_loops, 2u);
    EXPECT_TRUE(surface.warnings.empty()) << surface.warnings.front();
    expect_contact_on(mesh, surface, report);
  }
}

TEST(Build, BoxHasStraightBandsAndRoundCorners) {
  const Surface surface =
      build(water(sheet(30 * kMm, 1)), {solid(box({-5 * kMm, -10 * kMm, -4 * kMm}, {5 * kMm, 10 * kMm, 4 * kMm}), 30)});
  const double h0 = kSweep * 60 / 180;
  double expected = 2 * (10 + 8) * kMm * kSweep + glm::pi<double>() * kSweep * kSweep;
  EXPECT_NEAR(plan_area(surface, true), expected, 1e-3 * expected);
  for (const dvec3& p : surface.mesh.positions) {
    const double d =
        std::hypot(std::max(std::abs(p.x) - 5 * kMm, 0.0), std::max(std::abs(p.z) - 4 * kMm, 0.0)) / kSweep;
    EXPECT_NEAR(p.y, d < 1 ? h0 * (1 - std::sin(glm::half_pi<double>() * d)) : 0, 1e-12);
  }
}

TEST(Build, ConcaveCornersTrimThemselves) {
  const TriangleMesh mesh = star(5, 3 * kMm, 8 * kMm, -10 * kMm, 10 * kMm);
  const Surface surface = build(water(sheet(30 * kMm, 1)), {solid(mesh, 30)});
  const Report report = expect_sound(surface);
  EXPECT_EQ(report.boundary_loops, 2u);
  EXPECT_TRUE(surface.warnings.empty());
  expect_contact_on(mesh, surface, report);
}

TEST(Build, PinsTheContactLineAtTheSolidsTop) {
  const Surface surface =
      build(water(sheet(30 * kMm, 1)),
            {solid(box({-5 * kMm, -10 * kMm, -4 * kMm}, {5 * kMm, 0.5 * kMm, 4 * kMm}), 30, "slab")});
  expect_sound(surface);
  ASSERT_EQ(surface.warnings.size(), 1u);
  EXPECT_NE(surface.warnings[0].find("'slab'"), std::string::npos);
  EXPECT_NEAR(surface.contacts.at(0).rise_max, 0.5 * kMm, 1e-9);
}

}  // namespace

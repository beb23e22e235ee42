// Whole menisci: what the surface must be, by closed form or by topology.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "meniscus/check.h"
#include "meniscus/meniscus.h"
#include "tests/unit/meniscus_shapes.h"

using namespace shapes;
using glm::dvec3;
using meniscus::Report;
using meniscus::Surface;

namespace {

constexpr double kSweep = 2 * kWater;

TriangleMesh tall_post(int facets = 256) { return post(2 * kMm, -50 * kMm, 10 * kMm, facets); }

// What must hold of every result; gives the topology.
Report expect_sound(const Surface& surface, double least_angle = 1) {
  const TriangleMesh& mesh = surface.mesh;
  EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
  EXPECT_EQ(surface.meniscus.size(), mesh.triangles.size());
  std::vector<bool> used(mesh.positions.size(), false);
  std::size_t down = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const glm::uvec3& v = mesh.triangles[t];
    for (int i = 0; i < 3; ++i) used[v[i]] = true;
    down += surface.meniscus[t] &&
            glm::cross(mesh.positions[v.y] - mesh.positions[v.x], mesh.positions[v.z] - mesh.positions[v.x]).y <= 0;
  }
  EXPECT_EQ(down, 0u) << "meniscus triangles face down";
  EXPECT_TRUE(std::all_of(used.begin(), used.end(), [](bool u) { return u; })) << "unused vertices";
  for (const dvec3& n : mesh.normals) EXPECT_NEAR(glm::length(n), 1, 1e-9);
  std::set<std::vector<double>> distinct;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const dvec3 p = mesh.positions[i], n = mesh.normals[i];
    distinct.insert({p.x, p.y, p.z, n.x, n.y, n.z});
  }
  EXPECT_EQ(distinct.size(), mesh.positions.size()) << "duplicate vertices";
  const Report report = meniscus::inspect(mesh);
  EXPECT_EQ(report.rejected, 0u);
  EXPECT_EQ(report.genus, 0);
  EXPECT_GT(report.smallest_angle, least_angle);
  return report;
}

double plan_area(const Surface& surface, bool meniscus_only) {
  double sum = 0;
  for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
    if (meniscus_only && !surface.meniscus[t]) continue;
    const glm::uvec3& v = surface.mesh.triangles[t];
    const auto& p = surface.mesh.positions;
    sum += 0.5 * glm::cross(p[v.y] - p[v.x], p[v.z] - p[v.x]).y;
  }
  return sum;
}

double distance_to(const TriangleMesh& mesh, const dvec3& x) {
  double least = 1e300;
  for (const glm::uvec3& t : mesh.triangles) {
    const dvec3 p[3] = {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
    const dvec3 n = glm::cross(p[1] - p[0], p[2] - p[0]);
    bool over = true;
    for (int i = 0; i < 3; ++i) {
      const dvec3 e = p[(i + 1) % 3] - p[i];
      over = over && glm::dot(glm::cross(e, x - p[i]), n) >= 0;
      const double s = glm::clamp(glm::dot(x - p[i], e) / glm::dot(e, e), 0.0, 1.0);
      least = std::min(least, glm::distance(x, p[i] + s * e));
    }
    if (over) least = std::min(least, std::abs(glm::dot(x - p[0], n)) / glm::length(n));
  }
  return least;
}

// Boundary vertices that are not on the square border of the sheet.
std::set<std::size_t> contact_vertices(const Surface& surface, const Report& report, double half) {
  std::set<std::size_t> result;
  for (const auto& [a, b] : report.boundary) {
    for (const std::size_t v : {a, b}) {
      const dvec3 p = surface.mesh.positions[v];
      if (std::max(std::abs(p.x), std::abs(p.z)) < half * (1 - 1e-9)) result.insert(v);
    }
  }
  return result;
}

void expect_contact_on(const TriangleMesh& solid, const Surface& surface, const Report& report,
                       double half = 30 * kMm) {
  const auto contacts = contact_vertices(surface, report, half);
  EXPECT_GE(contacts.size(), 64u);
  double worst = 0;
  for (const std::size_t v : contacts) worst = std::max(worst, distance_to(solid, surface.mesh.positions[v]));
  EXPECT_LT(worst, 1e-7) << "metres between contact line and solid";
}

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
    EXPECT_GE(layers.size(), 64u);
    EXPECT_LE(layers.size(), 96u);
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

TEST(Build, LiquidFarFromTheSolidIsUntouched) {
  const auto waves = [](double x, double z) { return 0.3 * kMm * std::sin(x / (3 * kMm)) * std::cos(z / (4 * kMm)); };
  const TriangleMesh mesh = sheet(20 * kMm, 80, waves);
  const Surface surface = build(water(mesh), {solid(tall_post(), 30)});
  EXPECT_EQ(expect_sound(surface).boundary_loops, 2u);
  const auto corner_set = [](const TriangleMesh& m) {
    std::set<std::vector<double>> result;
    for (const glm::uvec3& t : m.triangles) {
      std::vector<double> key;
      for (int i = 0; i < 3; ++i) {
        for (const dvec3& v : {m.positions[t[i]], m.normals[t[i]]}) key.insert(key.end(), {v.x, v.y, v.z});
      }
      result.insert(key);
    }
    return result;
  };
  const auto kept = corner_set(surface.mesh);
  std::size_t checked = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    const dvec3 p = mesh.positions[t.x];
    if (std::hypot(p.x, p.z) < 2 * kMm + 1.05 * kSweep + 2 * kMm) continue;
    ++checked;
    EXPECT_TRUE(kept.contains(*corner_set({mesh.positions, mesh.normals, {t}}).begin()));
  }
  EXPECT_GT(checked, 5000u);
}

TEST(Build, TopologyDoesNotDependOnScaleOrPlace) {
  for (const double s : {1e-3, 1.0, 1e3}) {
    meniscus::Liquid liquid = water(scaled(sheet(30 * kMm, 1), s));
    liquid.capillary_length *= s;
    const Surface surface = build(liquid, {solid(scaled(tall_post(), s), 30)});
    EXPECT_EQ(expect_sound(surface, 10).boundary_loops, 2u);
    EXPECT_NEAR(static_cast<double>(surface.mesh.triangles.size()), 21304, 300);
    EXPECT_NEAR(surface.contacts[0].rise_max, s * kSweep * 60 / 180, 1e-12 * s);
  }
  const dvec3 far(10, 3, -7);
  const Surface surface = build(water(translated(sheet(30 * kMm, 1), far)), {solid(translated(tall_post(), far), 30)});
  EXPECT_EQ(expect_sound(surface, 10).boundary_loops, 2u);
}

TEST(Build, IsDeterministicAndBlindToTheSolidsWinding) {
  const Surface a = build(water(sheet(30 * kMm, 4)), {solid(tall_post(), 30)});
  const Surface b = build(water(sheet(30 * kMm, 4)), {solid(tall_post(), 30)});
  const Surface c = build(water(sheet(30 * kMm, 4)), {solid(inside_out(tall_post()), 30)});
  EXPECT_EQ(a.mesh.positions, b.mesh.positions);
  EXPECT_EQ(a.mesh.normals, b.mesh.normals);
  EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
  EXPECT_EQ(a.mesh.positions.size(), c.mesh.positions.size());
  EXPECT_NEAR(c.contacts.at(0).rise_max, kSweep * 60 / 180, 1e-12);
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
  EXPECT_TRUE(build(water(sheet(1 * kMm, 2)), {solid(post(8 * kMm, -5 * kMm, 5 * kMm, 32), 30)}).mesh.triangles.empty())
      << "a liquid wholly inside a solid is gone";
}

TEST(Build, RingLyingInTheSurfaceHasTwoContours) {
  const Surface surface = build(water(sheet(30 * kMm, 1)), {solid(torus(8 * kMm, 3 * kMm, 96, 48), 60)});
  const Report report = expect_sound(surface);
  EXPECT_EQ(surface.contacts.size(), 2u);
  EXPECT_EQ(report.components, 2u);
  EXPECT_EQ(report.boundary_loops, 3u);
}

TEST(Build, ConcaveCornersTrimThemselves) {
  const TriangleMesh mesh = star(5, 3 * kMm, 8 * kMm, -10 * kMm, 10 * kMm);
  const Surface surface = build(water(sheet(30 * kMm, 1)), {solid(mesh, 30)});
  const Report report = expect_sound(surface);
  EXPECT_EQ(report.boundary_loops, 2u);
  EXPECT_TRUE(surface.warnings.empty());
  expect_contact_on(mesh, surface, report);
}

TEST(Build, UnusableInputIsRefusedByName) {
  const auto message = [](const meniscus::Liquid& liquid, const std::vector<meniscus::Solid>& solids) {
    try {
      build(liquid, solids);
    } catch (const std::invalid_argument& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  TriangleMesh broken = tall_post(16);
  broken.triangles.emplace_back(0, 1, 100000);
  EXPECT_NE(message(water(sheet(1, 1)), {solid(broken, 30, "rod")}).find("'rod'"), std::string::npos);
  broken = tall_post(16);
  broken.positions[3].y = std::nan("");
  EXPECT_NE(message(water(sheet(1, 1)), {solid(broken, 30, "rod")}).find("'rod'"), std::string::npos);
  EXPECT_NE(message(water(sheet(1, 1)), {solid(tall_post(16), 200, "rod")}).find("'rod'"), std::string::npos);
  EXPECT_NE(message(water({}), {}).find("'water'"), std::string::npos);
  meniscus::Liquid liquid = water(sheet(1, 1));
  liquid.capillary_length = 0;
  EXPECT_NE(message(liquid, {}).find("'water'"), std::string::npos);
}

TEST(Build, ContactsKnowTheirTrianglesAndWhatConcernsThem) {
  // The stub ends 0.5 mm above the level, below the height that its meniscus would reach.
  const TriangleMesh tall = translated(post(2 * kMm, -10 * kMm, 10 * kMm, 64), {-15 * kMm, 0, 0});
  const TriangleMesh low = translated(post(1 * kMm, -10 * kMm, 0.5 * kMm, 64), {15 * kMm, 0, 0});
  const Surface surface = meniscus::build(water(sheet(40 * kMm, 4)), {solid(tall, 30, "tall"), solid(low, 30, "stub")});
  ASSERT_EQ(surface.contacts.size(), 2u);
  std::size_t by_side[2] = {0, 0};
  for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t)
    if (surface.meniscus[t]) ++by_side[surface.mesh.positions[surface.mesh.triangles[t].x].x > 0];
  for (const meniscus::Contact& contact : surface.contacts) {
    const bool stub = contact.solid == "stub";
    EXPECT_EQ(contact.triangles, by_side[stub]);
    EXPECT_EQ(contact.warnings.size(), stub ? 1u : 0u);
  }
}

}  // namespace

// How many triangles a meniscus takes, and that the surface between them is still the right one.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>

#include "meniscus/band.h"
#include "meniscus/check.h"
#include "meniscus/meniscus.h"
#include "meniscus/profile.h"
#include "meniscus/sizing.h"
#include "tests/unit/meniscus_shapes.h"

using namespace shapes;
using glm::dvec3;
using meniscus::Surface;

namespace {

constexpr double kSweep = 2 * kWater, kRise = kSweep * 60 / 180;  // of a vertical wall at 30 degrees

using Distance = std::function<double(double x, double z)>;

double height(double distance) {
  const double d = std::max(distance, 0.0) / kSweep;
  return d < 1 ? kRise * (1 - std::sin(glm::half_pi<double>() * d)) : 0;
}

// How far the facets of the menisci leave the true surface, metres.
struct Error {
  double worst = 0, rms = 0;
};
Error facet_error(const Surface& surface, const Distance& distance) {
  Error error;
  double squares = 0, area = 0;
  constexpr int kParts = 6;
  for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
    if (!surface.meniscus[t]) continue;
    const glm::uvec3& v = surface.mesh.triangles[t];
    const dvec3 a = surface.mesh.positions[v.x], b = surface.mesh.positions[v.y], c = surface.mesh.positions[v.z];
    const double size = glm::length(glm::cross(b - a, c - a));
    for (int i = 0; i <= kParts; ++i) {
      for (int j = 0; i + j <= kParts; ++j) {
        const dvec3 p = a + (b - a) * (1.0 * i / kParts) + (c - a) * (1.0 * j / kParts);
        const double e = std::abs(p.y - height(distance(p.x, p.z)));
        error.worst = std::max(error.worst, e);
        squares += size * e * e, area += size;
      }
    }
  }
  error.rms = std::sqrt(squares / area);
  return error;
}

double triangles_per_metre(const Surface& surface) {
  double length = 0;
  for (const meniscus::Contact& contact : surface.contacts) length += contact.length;
  return static_cast<double>(surface.mesh.triangles.size()) / length;
}

TEST(Sizing, StraightWallsTakeFewTrianglesAndKeepTheirShape) {
  constexpr double kX = 200 * kMm, kZ = 20 * kMm;
  const Surface surface =
      build(water(sheet(300 * kMm, 1)), {solid(box({-kX, -10 * kMm, -kZ}, {kX, 10 * kMm, kZ}), 30)});
  EXPECT_TRUE(surface.warnings.empty());
  EXPECT_LT(triangles_per_metre(surface), 140e3);
  const meniscus::Report report = meniscus::inspect(surface.mesh);
  EXPECT_EQ(report.rejected, 0u);
  EXPECT_EQ(report.boundary_loops, 2u);
  EXPECT_GT(report.smallest_angle, 2.9);
  std::set<double> layers;
  for (std::size_t i = 0; i < surface.mesh.positions.size(); ++i) {
    const dvec3 p = surface.mesh.positions[i];
    const double d = std::hypot(std::max(std::abs(p.x) - kX, 0.0), std::max(std::abs(p.z) - kZ, 0.0));
    EXPECT_NEAR(p.y, height(d), 1e-12);
    if (std::abs(p.x) >= kX || std::abs(p.z) < kZ || d >= kSweep * (1 - 1e-9)) continue;
    layers.insert(std::round(d / kSweep * 1e6));  // along the long walls
    const double slope = -kRise * glm::half_pi<double>() / kSweep * std::cos(glm::half_pi<double>() * d / kSweep);
    const dvec3 n = glm::normalize(dvec3(0, 1, -slope * std::copysign(1.0, p.z)));
    EXPECT_LT(glm::distance(surface.mesh.normals[i], n), 1e-9) << "at " << p.x << " " << d;
  }
  EXPECT_GE(layers.size(), 64u);
  EXPECT_LE(layers.size(), 96u);
  const Error error = facet_error(surface, [&](double x, double z) {
    return std::hypot(std::max(std::abs(x) - kX, 0.0), std::max(std::abs(z) - kZ, 0.0));
  });
  EXPECT_LT(error.rms, 0.15e-6);
  EXPECT_LT(error.worst, 4e-6);
}

TEST(Sizing, TrayKeepsTheCreasesOfItsCorners) {
  constexpr double kHalf = 80 * kMm;
  const Surface surface = build(water(sheet(82 * kMm, 1)), {solid(tray(kHalf, 5 * kMm, -10 * kMm, 10 * kMm), 30)});
  EXPECT_TRUE(surface.warnings.empty());
  EXPECT_LT(triangles_per_metre(surface), 130e3);
  const meniscus::Report report = meniscus::inspect(surface.mesh);
  EXPECT_EQ(report.rejected, 0u);
  EXPECT_EQ(report.boundary_loops, 1u);
  EXPECT_GT(report.smallest_angle, 2.8);
  const Distance distance = [](double x, double z) { return kHalf - std::max(std::abs(x), std::abs(z)); };
  for (const dvec3& p : surface.mesh.positions) EXPECT_NEAR(p.y, height(distance(p.x, p.z)), 1e-12);
  const Error error = facet_error(surface, distance);
  EXPECT_LT(error.rms, 0.6e-6);
  EXPECT_LT(error.worst, 60e-6);  // in the corner itself, where the surface has a crease
}

TEST(Sizing, WallBesideAPostIsFineWhereTheyMeet) {
  const TriangleMesh wall = box({-20 * kMm, -10 * kMm, -24 * kMm}, {20 * kMm, 10 * kMm, -4 * kMm});
  const Surface surface = build(water(sheet(40 * kMm, 1)),
                                {solid(wall, 30, "wall"), solid(post(2 * kMm, -50 * kMm, 10 * kMm, 1024), 30, "post")});
  EXPECT_EQ(meniscus::inspect(surface.mesh).boundary_loops, 3u);
  const Error error = facet_error(surface, [](double x, double z) {
    const double to_wall =
        std::hypot(std::max(std::abs(x) - 20 * kMm, 0.0), std::max(std::abs(z + 14 * kMm) - 10 * kMm, 0.0));
    return std::min(std::hypot(x, z) - 2 * kMm, to_wall);
  });
  EXPECT_LT(error.rms, 0.9e-6);
  EXPECT_LT(error.worst, 60e-6);
}

TEST(Sizing, LyingRodKeepsTheOrderOfItsCorners) {
  // The line climbs round the rod, so that its corners move inward along the rod's flat ends.
  const TriangleMesh rod = turned(post(2 * kMm, -100 * kMm, 100 * kMm, 256), 90, {1, 0, 0});
  const Surface surface = build(water(sheet(150 * kMm, 1)), {solid(rod, 30)});
  EXPECT_TRUE(surface.warnings.empty()) << surface.warnings.front();
  EXPECT_LT(triangles_per_metre(surface), 180e3);
  const meniscus::Report report = meniscus::inspect(surface.mesh);
  EXPECT_EQ(report.rejected, 0u);
  EXPECT_EQ(report.boundary_loops, 2u);
  EXPECT_GT(report.smallest_angle, 2.8);
}

TEST(Sizing, WidePostsHaveMoreColumnsButFewerForTheirLength) {
  double columns = 0, density = 1e300;
  for (const double radius : {0.5 * kMm, 2 * kMm, 8 * kMm, 20 * kMm}) {
    const Surface surface =
        build(water(sheet(10 * kMm + 2 * radius, 1)), {solid(post(radius, -50 * kMm, 10 * kMm, 512), 30)});
    double contact = 0;
    for (const dvec3& p : surface.mesh.positions) contact += std::hypot(p.x, p.z) < radius * (1 + 1e-9);
    EXPECT_GT(contact, columns) << "radius " << radius;
    EXPECT_LT(triangles_per_metre(surface), density) << "radius " << radius;
    if (radius == 2 * kMm) {
      EXPECT_NEAR(contact, 128, 2);
    }
    columns = contact, density = triangles_per_metre(surface);
  }
}

TEST(Sizing, EndlessContoursAreCoarsenedWithAWarning) {
  // A tray of half a metre, a pool of 10 m and one of 100 m.
  for (const double half : {0.25, 5.0, 50.0}) {
    const meniscus::Topology level = meniscus::weld(sheet(1.1 * half, 1), "water");
    const std::vector<std::uint32_t> surface = meniscus::free_surface(level);
    const dvec3 up(0, 1, 0), side[4] = {{1, 0, 0}, {0, 0, -1}, {-1, 0, 0}, {0, 0, 1}};
    meniscus::Contour contour{true, {}};
    for (int k = 0; k < 4; ++k) {  // the walls' outward normals point into the liquid
      const dvec3 before = side[(k + 3) % 4], after = side[k];
      contour.points.push_back({half * (-before - after), up, before, after, {}});
    }
    const std::vector<meniscus::ContactLine> lines{
        refine(contour, 0, kSweep, {{}, find_fineness(contour, glm::radians(30.0), water({}))})};
    const meniscus::Patch patch(level, surface, lines, 1.05 * kSweep);
    std::vector<meniscus::Body> bodies;
    bodies.push_back({"pool", {}, meniscus::Tree({}), 0.5});
    meniscus::Warnings warnings;
    const auto resolution = find_resolutions(lines, bodies, patch, kSweep, kSweep, warnings);
    ASSERT_EQ(resolution.size(), 1u);
    const meniscus::ContactLine line = refine(contour, 0, kSweep, resolution[0]);
    const meniscus::Grading grading(line, kSweep);
    const double triangles = 2 * static_cast<double>(line.nodes.size() * grading.layers(kSweep).size());
    if (half < 1) {
      EXPECT_TRUE(warnings.empty());
      EXPECT_EQ(resolution[0].fineness.layer, lines[0].fineness.layer);
      continue;
    }
    ASSERT_EQ(warnings.size(), 1u) << half;
    EXPECT_NE(warnings[0].text.find("'pool'"), std::string::npos);
    EXPECT_GT(resolution[0].fineness.layer, 1.4 * lines[0].fineness.layer);
    EXPECT_LT(triangles, 1.6e6);
    EXPECT_GT(triangles, 1.0e6);
  }
}

}  // namespace

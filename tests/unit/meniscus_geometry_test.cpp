// Predicates, triangulation and nearest contour points: the ground that the menisci stand on.
#include <gtest/gtest.h>

#include <random>

#include "meniscus/field.h"
#include "meniscus/predicates.h"
#include "meniscus/topology.h"
#include "meniscus/triangulate.h"
#include "tests/unit/meniscus_shapes.h"

using namespace meniscus;
using glm::dvec2;
using glm::dvec3;

namespace {

TEST(Predicates, TurnsAreExactBesideALine) {
  // The points (0.5 + i u, 0.5 + j u) against the line through (12, 12) and (24, 24): the sign is that of j - i,
  // exactly.
  const double u = std::ldexp(1.0, -53);
  for (int i = 0; i < 16; ++i) {
    for (int j = 0; j < 16; ++j) {
      const int sign = orient2d({12, 12}, {24, 24}, {0.5 + i * u, 0.5 + j * u});
      EXPECT_EQ(sign, ((0.5 + j * u) > (0.5 + i * u)) - ((0.5 + j * u) < (0.5 + i * u))) << i << " " << j;
    }
  }
}

TEST(Predicates, SidesOfAPlaneAreExact) {
  // Points on and one ulp off the plane x + y + z = 3, whose floating-point determinant is mostly noise.
  const dvec3 a(3, 0, 0), b(0, 3, 0), c(0, 0, 3);
  std::mt19937 random(1);
  for (int i = 0; i < 1000; ++i) {
    const double x = std::ldexp(static_cast<double>(random() % 4096), -12),
                 y = std::ldexp(static_cast<double>(random() % 4096), -12);
    const double z = 3 - x - y;  // exact: 12 bits each
    EXPECT_EQ(orient3d(a, b, c, {x, y, z}), 0);
    EXPECT_EQ(orient3d(a, b, c, {x, y, std::nextafter(z, 9)}), 1);
    EXPECT_EQ(orient3d(a, b, c, {x, y, std::nextafter(z, -9)}), -1);
    EXPECT_EQ(orient3d(a, c, b, {x, y, std::nextafter(z, 9)}), -1);
  }
}

TEST(Predicates, ShiftDecidesEveryTieAndDecidesItAlike) {
  const dvec3 liquid[3] = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}};  // counter-clockwise from above
  ASSERT_EQ(orient3d(liquid[0], liquid[1], liquid[2], {0, 1, 0}), 1);
  EXPECT_EQ(Shift{1}.solid_above_liquid(liquid, {0.2, 0, 0.2}), 1);
  EXPECT_EQ(Shift{-1}.solid_above_liquid(liquid, {0.2, 0, 0.2}), -1);
  const dvec3 wall[3] = {{0, -1, 0}, {0, 1, 0}, {0, 0, 1}};  // the liquid's corner lies on it
  const int before = Shift{1}.liquid_before_solid(wall, {0, 0, 0.1});
  EXPECT_NE(before, 0);
  // Moved by a small amount instead of an infinitesimal one, the signs are the same.
  const dvec3 by(1e-6, 1e-3, 1e-9);
  EXPECT_EQ(before, orient3d(wall[0] + by, wall[1] + by, wall[2] + by, {0, 0, 0.1}));
  const dvec3 c(0.3, -1, 0), d(0.3, 1, 0);  // passes the liquid's edge x
  EXPECT_EQ(Shift{1}.edges(liquid[0], liquid[2], c, d), orient3d(liquid[0], liquid[2], c + by, d + by));
}

double area(const Triangulation& mesh, std::uint32_t t) {
  const auto& v = mesh.triangles()[t].v;
  const auto& p = mesh.points();
  return 0.5 * cross(p[v[1]] - p[v[0]], p[v[2]] - p[v[0]]);
}

TEST(Triangulation, IsDelaunayAndCoversItsTriangle) {
  Triangulation mesh({0, 0}, {1, 1});
  const double whole = area(mesh, 0);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 400; ++i) mesh.insert({uniform(random), uniform(random)});
  for (int i = 0; i < 100; ++i) mesh.insert({0.25 + 0.005 * i, 0.5});           // on one line
  for (int i = 0; i < 100; ++i) mesh.insert({0.1 * (i % 10), 0.1 * (i / 10)});  // a grid: all cocircular
  double sum = 0;
  for (std::uint32_t t = 0; t < mesh.triangles().size(); ++t) {
    ASSERT_GT(area(mesh, t), 0);
    sum += area(mesh, t);
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t u = mesh.triangles()[t].n[i];
      if (u == Triangulation::kNone) continue;
      const auto &a = mesh.triangles()[t].v, &b = mesh.triangles()[u].v;
      for (const std::uint32_t k : b) {
        if (k == a[0] || k == a[1] || k == a[2]) continue;
        const dvec2 d = mesh.points()[k], p = mesh.points()[a[0]] - d, q = mesh.points()[a[1]] - d,
                    r = mesh.points()[a[2]] - d;
        const double in = glm::dot(p, p) * cross(q, r) + glm::dot(q, q) * cross(r, p) + glm::dot(r, r) * cross(p, q);
        const double size = glm::dot(p, p) * glm::length(q) * glm::length(r);
        EXPECT_LT(in, 1e-9 * size + 1e-12 * glm::dot(q, q) * glm::length(p) * glm::length(r));
      }
    }
  }
  EXPECT_NEAR(sum, whole, 1e-9 * whole);
  EXPECT_EQ(mesh.insert(mesh.points()[5]), 5u);
}

TEST(Triangulation, CrossingConstraintsMeetInANewVertex) {
  Triangulation mesh({0, 0}, {1, 1});
  const auto a = mesh.insert({0, 0}), b = mesh.insert({1, 1}), c = mesh.insert({0, 1}), d = mesh.insert({1, 0});
  mesh.insert({0.5, 0.2});
  mesh.constrain(a, b, {1, 0});
  mesh.constrain(c, d, {0, 1});
  mesh.constrain(b, a, {1, 0});  // back again: the windings cancel
  ASSERT_EQ(mesh.points().size(), 9u);
  EXPECT_EQ(mesh.points().back(), dvec2(0.5, 0.5));
  int solid = 0, patch = 0;
  for (std::uint32_t t = 0; t < mesh.triangles().size(); ++t) {
    ASSERT_GT(area(mesh, t), 0);
    for (int i = 0; i < 3; ++i) {
      int sense = 0;
      if (const Crossing* crossing = mesh.constraint(t, i, sense))
        solid += std::abs(crossing->solid), patch += std::abs(crossing->patch);
    }
  }
  EXPECT_EQ(solid, 0);
  EXPECT_EQ(patch, 4);  // two halves, seen from both sides
}

TEST(Topology, WindingNumberTellsInsideAndTurnsInwardSolids) {
  Topology sphere = weld(shapes::inside_out(shapes::sphere(1, 24, 12)), "sphere");
  EXPECT_NEAR(winding_number(sphere, {0.1, 0.2, 0.3}), -1, 1e-9);
  EXPECT_TRUE(orient_outward(sphere));
  EXPECT_NEAR(winding_number(sphere, {0.1, 0.2, 0.3}), 1, 1e-9);
  EXPECT_NEAR(winding_number(sphere, {2, 0.2, 0.3}), 0, 1e-9);
  for (std::size_t t = 0; t < sphere.triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) EXPECT_GT(glm::dot(sphere.triangles[t].normals[i], sphere.corner(t, i)), 0.99);
  }
}

// A square of side 2 whose sides face outward: the walk goes clockwise in (z, x).
ContactLine square() {
  ContactLine line{0, true, 1, {}};
  const dvec2 corners[4] = {{-1, -1}, {-1, 1}, {1, 1}, {1, -1}}, normals[4] = {{-1, 0}, {0, 1}, {1, 0}, {0, -1}};
  for (int i = 0; i < 4; ++i) {
    Node node{};
    node.position = lifted(corners[i], 0);
    node.joint = true;
    node.before.direction = normals[(i + 3) % 4];
    node.after.direction = normals[i];
    node.contact.direction = glm::normalize(node.before.direction + node.after.direction);
    line.nodes.push_back(node);
  }
  return line;
}

TEST(Field, DistanceToASquareIsThatToItsSidesAndCorners) {
  const std::vector<ContactLine> lines{square()};
  const Field field(lines);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-4, 4);
  for (int i = 0; i < 1000; ++i) {
    const dvec2 x{uniform(random), uniform(random)};
    const dvec2 away = glm::max(glm::abs(x) - 1.0, 0.0);
    const Foot foot = field.foot(x);
    if (away == dvec2(0)) {
      EXPECT_FALSE(foot.exists());
      continue;
    }
    ASSERT_TRUE(foot.exists());
    EXPECT_NEAR(foot.distance, glm::length(away), 1e-12);
    EXPECT_NEAR(glm::distance(foot.direction, glm::sign(x) * away / glm::length(away)), 0, 1e-12);
    EXPECT_EQ(foot.fan > 0, away.x > 0 && away.y > 0);
  }
}

}  // namespace

// What the solver of the exact meniscus is made of: forces on facets, their derivatives, and fitted normals.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "meniscus/fitted_normals.h"
#include "meniscus/tension.h"
#include "tests/unit/meniscus_shapes.h"

using glm::dvec3;
using meniscus::corner_shares;
using meniscus::facet_forces;
using meniscus::FacetForces;

namespace {

constexpr double kLength = 1.7;  // capillary length
const dvec3 kFacet[3] = {{0.3, 0.5, -0.2}, {1.4, 0.9, 0.1}, {0.6, 0.2, 1.1}};
const dvec3 kShares(0.3, 0.45, 0.25);

double area(const dvec3 p[3]) { return 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0])); }

// The derivative of value(corners) as one coordinate of one corner changes.
template <typename Value>
auto difference(const Value& value, int corner, int axis) {
  constexpr double kStep = 1e-6;
  dvec3 more[3], less[3];
  std::copy(kFacet, kFacet + 3, more), std::copy(kFacet, kFacet + 3, less);
  more[corner][axis] += kStep, less[corner][axis] -= kStep;
  return (value(more) - value(less)) / (2 * kStep);
}

TEST(FacetForces, OfTensionAreTheGradientOfTheArea) {
  const FacetForces f = facet_forces(kFacet, kShares, kLength);
  for (int i = 0; i < 3; ++i) {
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR((f.on[i] - f.weight[i] * f.normal)[axis], difference(area, i, axis), 1e-9) << i << " " << axis;
  }
}

// With a level facet's energy, area y^2 / (2 L^2), and along the normal of a slanted one.
TEST(FacetForces, OfWeightAreThoseOfTheLiquidLifted) {
  const dvec3 up(0, 0.4, 0), level[3] = {up, up + dvec3(0, 0, 1), up + dvec3(1, 0, 0)};
  const FacetForces f = facet_forces(level, dvec3(1.0 / 3), kLength);
  const dvec3 sum = f.on[0] + f.on[1] + f.on[2];
  EXPECT_NEAR(sum.y, 0.5 * 0.4 / (kLength * kLength), 1e-12);
  EXPECT_NEAR(std::hypot(sum.x, sum.z), 0, 1e-12);
  const FacetForces g = facet_forces(kFacet, kShares, kLength);
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(g.weight[i], kShares[i] * area(kFacet) * kFacet[i].y / (kLength * kLength), 1e-12) << i;
}

TEST(FacetForces, HaveTheDerivativesOfFiniteDifferences) {
  const FacetForces f = facet_forces(kFacet, kShares, kLength);
  const auto now = [](const dvec3 p[3]) { return facet_forces(p, kShares, kLength); };
  for (int j = 0; j < 3; ++j) {
    for (int axis = 0; axis < 3; ++axis) {
      const dvec3 turn = difference([&](const dvec3 p[3]) { return now(p).normal; }, j, axis);
      EXPECT_LT(glm::distance(f.turn[j][axis], turn), 1e-8) << j << " " << axis;
      for (int i = 0; i < 3; ++i) {
        const dvec3 change = difference([&](const dvec3 p[3]) { return now(p).on[i]; }, j, axis);
        EXPECT_LT(glm::distance(f.change[i][j][axis], change), 1e-8) << i << " " << j << " " << axis;
        const double weight = difference([&](const dvec3 p[3]) { return now(p).weight[i]; }, j, axis);
        EXPECT_NEAR(f.weight_change[i][j][axis], weight, 1e-8) << i << " " << j << " " << axis;
      }
    }
  }
}

TEST(CornerShares, AreWhatIsNearestToEachCorner) {
  constexpr int kGrid = 600;
  dvec3 counts(0);
  for (int a = 0; a < kGrid; ++a) {
    for (int b = 0; a + b < kGrid; ++b) {
      const double u = (a + 1.0 / 3) / kGrid, v = (b + 1.0 / 3) / kGrid;
      const dvec3 p = kFacet[0] + u * (kFacet[1] - kFacet[0]) + v * (kFacet[2] - kFacet[0]);
      int nearest = 0;
      for (int i = 1; i < 3; ++i)
        if (glm::distance(p, kFacet[i]) < glm::distance(p, kFacet[nearest])) nearest = i;
      ++counts[nearest];
    }
  }
  const dvec3 shares = corner_shares(kFacet);
  EXPECT_LT(glm::distance(shares, counts / (counts.x + counts.y + counts.z)), 5e-3);
  EXPECT_NEAR(shares.x + shares.y + shares.z, 1, 1e-12);
}

TEST(CornerShares, AreHalfAtAnObtuseCorner) {
  const dvec3 obtuse[3] = {{1, 0, 0}, {0, 0, 0.1}, {-1, 0, 0}};
  EXPECT_EQ(corner_shares(obtuse), dvec3(0.25, 0.5, 0.25));
}

// The largest error, radians, of the normals fitted to an uneven mesh of a surface height(x, z), away from its border.
double worst_normal(const std::function<double(double, double)>& height, const std::function<dvec3(dvec3)>& normal,
                    int cells) {
  meniscus::TriangleMesh mesh = shapes::sheet(1, cells);
  std::mt19937 random(5);
  for (dvec3& p : mesh.positions) {
    const auto shift = [&] { return 0.5 * (static_cast<double>(random()) / 4294967296.0 - 0.5) / cells; };
    p.x += shift(), p.z += shift(), p.y = height(p.x, p.z);
  }
  std::vector<dvec3> about;
  for (const dvec3& p : mesh.positions) about.push_back(glm::normalize(normal(p) + dvec3(0.1, 0, -0.07)));
  const std::vector<dvec3> fitted = meniscus::fit_normals(mesh.positions, mesh.triangles, about);
  double worst = 0;
  for (std::size_t v = 0; v < fitted.size(); ++v) {
    const dvec3& p = mesh.positions[v];
    if (std::max(std::abs(p.x), std::abs(p.z)) > 0.7) continue;
    worst = std::max(worst, glm::length(glm::cross(fitted[v], normal(p))));
  }
  return worst;
}

TEST(FittedNormals, AreOfSecondOrder) {
  const auto ball = [](double x, double z) { return std::sqrt(4 - x * x - z * z); };
  const auto on_ball = [](dvec3 p) { return glm::normalize(p); };
  const auto bowl = [](double x, double z) { return 0.4 * x * x - 0.3 * z * z + 0.2 * x * z + 0.5 * x; };
  const auto on_bowl = [](dvec3 p) {
    return glm::normalize(dvec3(-0.8 * p.x - 0.2 * p.z - 0.5, 1, 0.6 * p.z - 0.2 * p.x));
  };
  const auto check = [](const auto& height, const auto& normal) {
    const double coarse = worst_normal(height, normal, 12), middle = worst_normal(height, normal, 24);
    const double fine = worst_normal(height, normal, 48);
    EXPECT_LT(coarse, 0.01);
    EXPECT_LT(middle, coarse / 3);
    EXPECT_LT(fine, middle / 3);
  };
  check(ball, on_ball), check(bowl, on_bowl);
}

TEST(FittedNormals, OfTooFewNeighboursAreTheRoughOnes) {
  const std::vector<dvec3> corners{kFacet[0], kFacet[1], kFacet[2]}, about(3, glm::normalize(dvec3(0.1, 1, 0.3)));
  EXPECT_EQ(meniscus::fit_normals(corners, {{0, 1, 2}}, about), about);
}

}  // namespace

// The exact rise against tables of independent solutions, and the curvature of contours that it goes by.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "meniscus/curvature.h"
#include "meniscus/profile.h"
#include "meniscus/young_laplace.h"
#include "tests/support/csv.h"
#include "tests/unit/meniscus_shapes.h"

using namespace shapes;
using glm::dvec2;
using glm::dvec3;
using meniscus::exact_rise;

namespace {

using meniscal::test::number;
using meniscal::test::read_csv;
using meniscal::test::Row;

std::vector<Row> table(const std::string& name) { return read_csv(std::string(TEST_DATA) + "/" + name); }

// The tables have nine decimals.
void expect_rise(double rise, double expected) { EXPECT_NEAR(rise, expected, 1e-6 * std::abs(expected) + 1e-9); }

TEST(ExactRise, OfPostsIsThatOfTheTable) {
  const std::vector<Row> rows = table("h0_cylinder_exterior.csv");
  ASSERT_EQ(rows.size(), 15u);
  for (const Row& row : rows) {
    ASSERT_EQ(row.size(), 18u);
    for (const auto& [column, cell] : row) {
      if (column == "R_over_L") continue;
      SCOPED_TRACE("radius " + row.at("R_over_L") + ", " + column);
      const double theta = std::stod(column.substr(std::string("theta_").size()));
      expect_rise(exact_rise(glm::radians(90 - theta), 1 / number(row, "R_over_L")), std::stod(cell));
    }
  }
}

TEST(ExactRise, InTubesIsThatOfTheTable) {
  const std::vector<Row> rows = table("h0_tube_interior.csv");
  ASSERT_EQ(rows.size(), 63u);
  for (const Row& row : rows) {
    SCOPED_TRACE("radius " + row.at("R_over_L") + ", theta " + row.at("theta"));
    expect_rise(exact_rise(glm::radians(90 - number(row, "theta")), -1 / number(row, "R_over_L")),
                number(row, "h_wall"));
  }
}

TEST(ExactRise, AtFlatWallsIsThatOfTheTable) {
  const std::vector<Row> rows = table("h0_tilted_wall.csv");
  ASSERT_EQ(rows.size(), 77u);
  meniscus::Liquid liquid = water({});
  liquid.height_rule = meniscus::HeightRule::exact;
  for (const Row& row : rows) {
    SCOPED_TRACE("beta " + row.at("beta_through_liquid") + ", theta " + row.at("theta"));
    const double beta = glm::radians(number(row, "beta_through_liquid")), theta = glm::radians(number(row, "theta"));
    for (const double radius : {1e300, 1e9 * kWater, -1e9 * kWater}) {
      expect_rise(meniscus::rise(liquid, theta, beta, 1 / radius) / kWater, number(row, "h0_over_L"));
    }
  }
}

TEST(ExactRise, OfAHairAndOfMercury) {
  EXPECT_NEAR(exact_rise(glm::half_pi<double>(), kWater / 35e-6) * kWater, 0.18076e-3, 0.00001e-3);
  EXPECT_NEAR(exact_rise(glm::radians(-50.0), 1.912 / 2) * 1.912, -1.148, 0.0005);
}

// Without gravity a post's liquid is a catenoid: h = R sin(phi) (ln(4 / (R (1 + cos phi))) - 0.5772) with an error of
// order R^2 (James 1974).
TEST(ExactRise, OfTheThinnestPostsIsJamesAsymptote) {
  constexpr double kEuler = 0.57721566490153286;
  for (const double radius : {3.7e-4, 1e-5, 2e-6}) {  // 1 um in water is 3.7e-4
    for (const double degrees : {1.0, 33.0, 60.0, 89.0, 112.0, 140.0}) {
      const double phi = glm::radians(degrees);
      const double asymptote = radius * std::sin(phi) * (std::log(4 / (radius * (1 + std::cos(phi)))) - kEuler);
      EXPECT_NEAR(exact_rise(phi, 1 / radius) / asymptote, 1, 2e-6) << radius << " " << degrees;
    }
  }
}

TEST(ExactRise, IsSmoothFromPostToTubeAndBeyondTheTable) {
  for (const double degrees : {10.0, 60.0, 90.0, 120.0}) {
    const double phi = glm::radians(degrees), flat = 2 * std::sin(phi / 2);
    const double bend = (exact_rise(phi, 1e-3) - exact_rise(phi, -1e-3)) / 2e-3;
    EXPECT_LT(bend, -0.03 * flat) << degrees;
    for (const double curvature : {-9e-5, -2e-5, 2e-5, 9e-5, 1.1e-4}) {
      EXPECT_NEAR(exact_rise(phi, curvature) - flat, bend * curvature, 3e-7 * flat) << degrees << " " << curvature;
    }
    double last = 1e300;  // by ever thinner posts, from the narrowest tube on
    for (double x = -12; x < 12; x += 0.01) {
      const double rise = exact_rise(phi, std::sinh(x));
      EXPECT_LT(rise, last) << degrees << " " << std::sinh(x);
      EXPECT_EQ(exact_rise(-phi, std::sinh(x)), -rise);
      last = rise;
    }
  }
}

// A contour round a polygon (z, x), given counter-clockwise as for `prism`: the way goes round it clockwise. Smooth:
// its normals point away from the origin.
meniscus::ContactLine round(std::vector<dvec2> polygon, bool smooth, bool closed = true) {
  std::reverse(polygon.begin(), polygon.end());
  const std::size_t n = polygon.size();
  const auto normal = [&](std::size_t i) {
    const dvec2 e = glm::normalize(polygon[(i + 1) % n] - polygon[i % n]);
    return dvec3(e.x, 0, -e.y);
  };
  meniscus::Contour contour{closed, {}};
  for (std::size_t i = 0; i < n; ++i) {
    const dvec3 p{polygon[i].y, 0, polygon[i].x}, out = glm::normalize(p);
    contour.points.push_back({p, {0, 1, 0}, smooth ? out : normal(i + n - 1), smooth ? out : normal(i), {}});
  }
  return refine(contour, 0, 2 * kWater);
}
std::vector<dvec2> circle(double radius, int n, double turn = 2 * glm::pi<double>()) {
  std::vector<dvec2> polygon;
  for (int i = 0; i < n; ++i) polygon.emplace_back(radius * std::cos(turn * i / n), radius * std::sin(turn * i / n));
  return polygon;
}

TEST(Curvature, OfACircleIsThatOfItsRadiusWhateverItsSize) {
  const auto worst = [](meniscus::ContactLine line, double radius) {
    measure_curvature(line, kWater);
    double error = 0;
    for (const meniscus::Node& node : line.nodes) error = std::max(error, std::abs(node.curvature * radius - 1));
    return error;
  };
  for (const double radius : {1e-6, 0.1 * kMm, 2 * kMm, 100 * kMm}) {
    if (radius < 10 * kMm) {
      EXPECT_LT(worst(round(circle(radius, 128), true), radius), 1e-10) << radius;
    }
    for (const int facets : {256, 1000}) {  // columns start on chords, which are nearer to the centre
      EXPECT_LT(worst(round(circle(radius, facets), true), radius), 4e-4) << radius << " " << facets;
      EXPECT_LT(worst(round(circle(radius, facets, 2.5), true, false), radius), 4e-4) << radius << " " << facets;
    }
  }
}

TEST(Curvature, OfASquareIsFlatAwayFromCornersAndOfAThinOneThatOfACircleOfItsGirth) {
  const auto square = [](double half) {
    return std::vector<dvec2>{{-half, -half}, {half, -half}, {half, half}, {-half, half}};
  };
  meniscus::ContactLine wide = round(square(10 * kMm), false);
  measure_curvature(wide, kWater);
  for (const meniscus::Node& node : wide.nodes) {
    const dvec2 p(node.position.z, node.position.x);
    const double to_corner = 10 * kMm - std::min(std::abs(p.x), std::abs(p.y));
    const double expected = glm::half_pi<double>() * std::max(0.0, 1 - to_corner / kWater) / kWater;
    EXPECT_NEAR(node.curvature, expected, 1e-9 / kWater) << to_corner / kWater;
  }
  meniscus::ContactLine thin = round(square(0.02 * kMm), false);
  measure_curvature(thin, kWater);
  for (const meniscus::Node& node : thin.nodes) {
    EXPECT_NEAR(node.curvature * 0.16 * kMm / (2 * glm::pi<double>()), 1, 1e-3);
  }
}

}  // namespace

// Scenes for the tests of the exact meniscus, solved.
#pragma once

#include <gtest/gtest.h>

#include "tests/support/csv.h"
#include "tests/unit/meniscus_shapes.h"

namespace solved {

using namespace shapes;
using meniscal::test::number;
using meniscal::test::Row;

inline std::vector<Row> table(const std::string& name) {
  return meniscal::test::read_csv(std::string(TEST_DATA) + "/" + name);
}

inline meniscus::Liquid still_water(TriangleMesh mesh, double tolerance = 1) {
  meniscus::Liquid liquid = water(std::move(mesh));
  liquid.profile = meniscus::Profile::solved, liquid.tolerance = tolerance;
  return liquid;
}

// Of a scene in which all menisci are found.
inline meniscus::Surface solve(const meniscus::Liquid& liquid, const std::vector<meniscus::Solid>& solids) {
  meniscus::Surface surface = build(liquid, solids);
  EXPECT_GT(surface.solution.parts, 0u);
  EXPECT_EQ(surface.solution.failed, 0u);
  EXPECT_GT(surface.solution.unknowns, 0u);
  return surface;
}

// A level sheet of these half-widths.
inline TriangleMesh rectangle(double x, double z, int n) {
  return moved(sheet(1, n), glm::scale(glm::dmat4(1), glm::dvec3(x, 1, z)));
}

inline TriangleMesh around(double radius) { return sheet(radius + 10 * kWater, 40); }  // a post of this radius

inline meniscus::Surface solve_post(double radius, double degrees, double tolerance = 1) {
  return solve(still_water(around(radius), tolerance), {solid(post(radius, -10 * kWater, 10 * kWater, 256), degrees)});
}

// The whole contact line is at this height.
inline void expect_rise(const meniscus::Contact& contact, double rise, double relative) {
  constexpr double kLeast = 1e-5 * kWater;  // near 90 degrees
  const double bound = std::max(relative * std::abs(rise), kLeast);
  EXPECT_NEAR(contact.rise_min, rise, bound) << 100 * (contact.rise_min / rise - 1) << " %";
  EXPECT_NEAR(contact.rise_max, rise, bound) << 100 * (contact.rise_max / rise - 1) << " %";
}

}  // namespace solved

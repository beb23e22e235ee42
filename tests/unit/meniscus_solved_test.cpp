// The exact meniscus, solved on the mesh, against independent solutions in one dimension.
#include "tests/unit/meniscus_solved.h"

#include <algorithm>

using namespace solved;
using glm::dvec2;
using glm::dvec3;

namespace {

constexpr double kPrecise = 2e-3;  // relative
constexpr double kGrazing = 1e-2;  // where the surface touches the wall along a tangent

// Walls end with the liquid, so many metres to either side.
constexpr double kLength = 5 * kWater;

bool grazes(double theta) { return theta == 0 || theta == 180; }

void check_post(const Row& row, const std::string& theta) {
  SCOPED_TRACE("radius " + row.at("R_over_L") + ", theta " + theta);
  const double degrees = std::stod(theta);
  const meniscus::Surface surface = solve_post(number(row, "R_over_L") * kWater, degrees);
  ASSERT_EQ(surface.contacts.size(), 1u);
  expect_rise(surface.contacts[0], number(row, "theta_" + theta) * kWater, grazes(degrees) ? kGrazing : kPrecise);
}

TEST(SolvedHeight, OfPostsIsThatOfTheTable) {
  const std::vector<Row> rows = table("h0_cylinder_exterior.csv");
  const auto check = [&](const std::string& radius, const std::string& theta) {
    for (const Row& row : rows)
      if (row.at("R_over_L") == radius) return check_post(row, theta);
    FAIL() << radius;
  };
  check("0.05", "150"), check("0.5", "30"), check("1", "0"), check("2", "105");
}

// All rows with one value in one column.
class SolvedHeights : public testing::TestWithParam<const char*> {};
class OfAllPosts : public SolvedHeights {};
class InAllTubes : public SolvedHeights {};
class BetweenAllPlates : public SolvedHeights {};
class AtAllTiltedWalls : public SolvedHeights {};

TEST_P(OfAllPosts, AreThoseOfTheTable) {
  int checked = 0;
  for (const Row& row : table("h0_cylinder_exterior.csv")) {
    if (row.at("R_over_L") != GetParam()) continue;
    for (const auto& [column, cell] : row) {
      if (column == "R_over_L" || column == "theta_90") continue;
      check_post(row, column.substr(std::string("theta_").size()));
      ++checked;
    }
  }
  EXPECT_EQ(checked, 16);
}
INSTANTIATE_TEST_SUITE_P(Slow, OfAllPosts,
                         testing::Values("0.01", "0.0128", "0.02", "0.05", "0.1", "0.2", "0.5", "1", "2", "5", "10",
                                         "20", "50", "100"));

// Checks the rows of a table that `wanted` takes, and returns how many.
int check_rows(const std::string& name, const std::function<bool(const Row&)>& wanted, void (*check)(const Row&)) {
  int checked = 0;
  for (const Row& row : table(name))
    if (wanted(row)) check(row), ++checked;
  return checked;
}

// A liquid that ends within the tube's wall.
void check_tube(const Row& row) {
  SCOPED_TRACE("radius " + row.at("R_over_L") + ", theta " + row.at("theta"));
  const double radius = number(row, "R_over_L") * kWater, height = number(row, "h_wall") * kWater;
  const double low = 1.2 * std::min(height, 0.0) - kWater, high = 1.2 * std::max(height, 0.0) + kWater;
  const TriangleMesh tube = lathe(
      {{0, low - kWater}, {2 * radius, low - kWater}, {2 * radius, high}, {radius, high}, {radius, low}, {0, low}},
      128);
  const meniscus::Surface surface = solve(still_water(sheet(1.2 * radius, 20)), {solid(tube, number(row, "theta"))});
  ASSERT_EQ(surface.contacts.size(), 1u);
  expect_rise(surface.contacts[0], height, kPrecise);
}

TEST(SolvedHeight, InTubesIsThatOfTheTable) {
  const auto chosen = [](const Row& row) {
    const dvec2 at(number(row, "R_over_L"), number(row, "theta"));
    return at == dvec2(0.5, 30) || at == dvec2(2, 120);
  };
  EXPECT_EQ(check_rows("h0_tube_interior.csv", chosen, check_tube), 2);
}

TEST_P(InAllTubes, AreThoseOfTheTable) {
  const auto of_this = [](const Row& row) { return row.at("R_over_L") == GetParam() && number(row, "h_wall") != 0; };
  EXPECT_EQ(check_rows("h0_tube_interior.csv", of_this, check_tube), 6);
}
INSTANTIATE_TEST_SUITE_P(Slow, InAllTubes, testing::Values("0.05", "0.1", "0.2", "0.5", "1", "2", "5", "10", "20"));

void check_plates(const Row& row) {
  SCOPED_TRACE("gap " + row.at("gap_over_L") + ", theta " + row.at("theta"));
  const double half = number(row, "gap_over_L") / 2 * kWater, height = number(row, "h_wall") * kWater;
  const double low = 1.2 * std::min(height, 0.0) - kWater, high = 1.2 * std::max(height, 0.0) + kWater;
  const double theta = number(row, "theta"), wide = 1.01 * kLength;
  const meniscus::Surface surface =
      solve(still_water(rectangle(half + 0.5 * kWater, kLength, 20)),
            {solid(box({-half - kWater, low, -wide}, {-half, high, wide}), theta, "left"),
             solid(box({half, low, -wide}, {half + kWater, high, wide}), theta, "right")});
  ASSERT_EQ(surface.contacts.size(), 2u);
  for (const meniscus::Contact& contact : surface.contacts) expect_rise(contact, height, kPrecise);
}

TEST(SolvedHeight, BetweenPlatesIsThatOfTheTable) {
  const auto chosen = [](const Row& row) {
    const dvec2 at(number(row, "gap_over_L"), number(row, "theta"));
    return at == dvec2(1, 30) || at == dvec2(2, 120);
  };
  EXPECT_EQ(check_rows("h0_plates.csv", chosen, check_plates), 2);
}

TEST_P(BetweenAllPlates, AreThoseOfTheTable) {
  const auto of_this = [](const Row& row) { return row.at("gap_over_L") == GetParam() && number(row, "h_wall") != 0; };
  EXPECT_EQ(check_rows("h0_plates.csv", of_this, check_plates), 6);
}
INSTANTIATE_TEST_SUITE_P(Slow, BetweenAllPlates,
                         testing::Values("0.1", "0.2", "0.5", "1", "2", "3", "4", "6", "8", "10"));

// A wall whose foot is at x = 0 and which leaves the liquid, at x > 0, this angle.
TriangleMesh wall(double degrees, double wide) {
  return turned(box({-60 * kWater, -40 * kWater, -wide}, {0, 40 * kWater, wide}), 90 - degrees, {0, 0, 1});
}

void check_wall(const Row& row) {
  SCOPED_TRACE("beta " + row.at("beta_through_liquid") + ", theta " + row.at("theta"));
  const double beta = number(row, "beta_through_liquid"), height = number(row, "h0_over_L") * kWater;
  const meniscus::Surface surface =
      solve(still_water(translated(rectangle(12 * kWater, kLength, 24), {8 * kWater, 0, 0})),
            {solid(wall(beta, 1.01 * kLength), number(row, "theta"))});
  ASSERT_EQ(surface.contacts.size(), 1u);
  expect_rise(surface.contacts.front(), height, kPrecise);
}

TEST(SolvedHeight, AtTiltedWallsIsThatOfTheTable) {
  const auto chosen = [](const Row& row) {
    const dvec2 at(number(row, "beta_through_liquid"), number(row, "theta"));
    return at == dvec2(15, 180) || at == dvec2(90, 30) || at == dvec2(120, 60) || at == dvec2(165, 0);
  };
  EXPECT_EQ(check_rows("h0_tilted_wall.csv", chosen, check_wall), 4);
}

TEST_P(AtAllTiltedWalls, AreThoseOfTheTable) {
  const auto of_this = [](const Row& row) {
    return row.at("beta_through_liquid") == GetParam() && number(row, "h0_over_L") != 0;
  };
  EXPECT_GE(check_rows("h0_tilted_wall.csv", of_this, check_wall), 6);
}
INSTANTIATE_TEST_SUITE_P(Slow, AtAllTiltedWalls,
                         testing::Values("15", "30", "45", "60", "75", "90", "105", "120", "135", "150", "165"));

}  // namespace

// Points of triangles that light a point, whether they are specks in the sky or all of it, against Lambert's formula.
#include "shaders/shared/seen_triangle.h"

#include <gtest/gtest.h>

#include <array>
#include <glm/gtc/constants.hpp>
#include <string>

namespace meniscal {
namespace {

using glm::dvec3;

struct Case {
  std::string name;
  dvec3 corner, edge1, edge2;  // all of it above the plane z = 0 of the receiver, in the origin
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

// Irradiance on the plane z = 0 by a radiance of 1: Lambert's sum over the edges.
double irradiance(const Case& c) {
  const std::array<dvec3, 3> corners = {c.corner, c.corner + c.edge1, c.corner + c.edge2};
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const dvec3 a = corners[i], b = corners[(i + 1) % 3], across = glm::cross(a, b);
    sum += std::atan2(glm::length(across), glm::dot(a, b)) * across.z / glm::length(across);
  }
  return 0.5 * std::abs(sum);
}

class SeenTriangle : public testing::TestWithParam<Case> {};

TEST_P(SeenTriangle, LightsAsLambertSays) {
  const Case& c = GetParam();
  constexpr std::uint32_t side = 256;
  double sum = 0;
  for (std::uint32_t i = 0; i < side; ++i)
    for (std::uint32_t j = 0; j < side; ++j) {
      const glm::vec2 place((float(i) + 0.5f) / side, (float(j) + 0.5f) / side);
      const shared::SeenPoint seen =
          shared::sample_seen_triangle(glm::vec3(c.corner), glm::vec3(c.edge1), glm::vec3(c.edge2), place);
      ASSERT_TRUE(std::isfinite(seen.solid_angle));
      ASSERT_GE(std::min(seen.weights.x, seen.weights.y), 0);
      ASSERT_LT(seen.weights.x + seen.weights.y, 1 + 1e-3);
      const dvec3 on_it = c.corner + double(seen.weights.x) * c.edge1 + double(seen.weights.y) * c.edge2;
      if (seen.solid_angle > 0) {
        ASSERT_LT(glm::distance(on_it, double(seen.distance) * dvec3(seen.direction)), 1e-3 * (1 + double(seen.distance)));
      }
      sum += double(seen.solid_angle) * double(seen.direction.z);
    }
  EXPECT_NEAR(sum / (side * side), irradiance(c), 2e-3 * irradiance(c) + 1e-12);
}
INSTANTIATE_TEST_SUITE_P(
    Sizes, SeenTriangle,
    testing::Values(Case{"speck", {0.1, 0.2, 1}, {1e-4, 0, 0}, {0, 2e-4, 0}},
                    Case{"panel", {-0.3, -0.2, 1}, {0.5, 0, 0.1}, {0, 0.6, 0}},
                    Case{"upright", {1, -1, 0.1}, {0, 2, 0}, {0, 0, 3}},
                    Case{"beside_its_edge", {-500, -500, 0.1}, {1000, 0, 0}, {1000, 1000, 0}},
                    Case{"below_its_edge", {-500, 1e-3, 0.1}, {1000, 0, 0}, {0, 1000, 0}},
                    Case{"all_the_sky", {-500, -600, 0.1}, {1000, 0, 0}, {300, 2000, 0}},
                    Case{"a_kilometre_a_micrometre_above", {-500, -600, 1e-6}, {1000, 0, 0}, {300, 2000, 0}},
                    Case{"in_its_plane", {1, -1, 1e-12}, {0, 2, 0}, {3, 0, 0}}),
    [](const auto& tested) { return tested.param.name; });

// Each point counts for as much as its neighbours where the triangle is wide: shadows of the light are without specks.
TEST(SeenTriangleNearby, GivesEachPointTheSameSolidAngle) {
  const shared::SeenPoint one = shared::sample_seen_triangle({-5, -5, 0.1f}, {10, 0, 0}, {10, 10, 0}, {0.1f, 0.7f});
  const shared::SeenPoint other = shared::sample_seen_triangle({-5, -5, 0.1f}, {10, 0, 0}, {10, 10, 0}, {0.9f, 0.2f});
  EXPECT_FLOAT_EQ(one.solid_angle, other.solid_angle);
  EXPECT_NEAR(one.solid_angle, glm::pi<double>(), 0.1);
}

}  // namespace
}  // namespace meniscal

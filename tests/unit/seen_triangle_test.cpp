// Points of triangles that light a point and fill much of its sky, or all of it, against Lambert's formula and by
// counting directions.
#include "shaders/shared/seen_triangle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <string>

namespace meniscal {
namespace {

using glm::dvec3;

struct Case {
  std::string name;
  dvec3 corner, edge1, edge2;  // all of it above the plane z = 0 of the receiver, in the origin
  bool wide = true;            // as seen from there
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

bool meets(const Case& c, const dvec3& direction) {
  const dvec3 facing = glm::cross(c.edge1, c.edge2);
  const double distance = glm::dot(c.corner, facing) / glm::dot(direction, facing);
  const dvec3 inside = distance * direction - c.corner;
  const double v = glm::dot(glm::cross(inside, c.edge2), facing) / glm::dot(facing, facing);
  const double w = glm::dot(glm::cross(c.edge1, inside), facing) / glm::dot(facing, facing);
  return distance > 0 && std::min(v, w) >= 0 && v + w <= 1;
}

class SeenTriangle : public testing::TestWithParam<Case> {};

TEST_P(SeenTriangle, LightsAsLambertSays) {
  const Case& c = GetParam();
  const glm::vec3 corner(c.corner), edge1(c.edge1), edge2(c.edge2);
  const shared::SeenTriangle seen = shared::see_triangle(corner, edge1, edge2);
  ASSERT_EQ(seen.angle > 0, c.wide);
  if (!c.wide) return;
  constexpr std::uint32_t side = 256;
  double sum = 0;
  for (std::uint32_t i = 0; i < side; ++i)
    for (std::uint32_t j = 0; j < side; ++j) {
      const glm::vec2 place((float(i) + 0.5f) / side, (float(j) + 0.5f) / side);
      const shared::SeenPoint there = shared::sample_seen_triangle(seen, corner, edge1, edge2, place);
      if (there.missed) continue;
      ASSERT_NEAR(glm::length(dvec3(there.direction)), 1, 1e-6);
      const dvec3 on_it = c.corner + double(there.weights.x) * c.edge1 + double(there.weights.y) * c.edge2;
      // Off by how directions and weights are rounded.
      const dvec3 there_too = double(there.distance) * dvec3(there.direction);
      ASSERT_LT(glm::distance(on_it, there_too), 1e-3 * double(there.distance) + 1e-6 * glm::length(c.edge2))
          << i << " " << j;
      sum += double(seen.angle) * double(there.direction.z);
    }
  EXPECT_NEAR(sum / (side * side), irradiance(c), 2e-3 * irradiance(c));
}

// A narrow part of the triangle has its share of the directions, so what area does not do, solid angle does.
TEST_P(SeenTriangle, DirectionsLieEvenly) {
  const Case& c = GetParam();
  if (!c.wide) return;
  const glm::vec3 corner(c.corner), edge1(c.edge1), edge2(c.edge2);
  const shared::SeenTriangle seen = shared::see_triangle(corner, edge1, edge2);
  // Of each octant by azimuth and height: what of the samples falls into it, by those, and by a fine net over the
  // hemisphere.
  constexpr std::uint32_t side = 512;
  std::array<double, 32> found{}, expected{};
  const auto cell = [](const dvec3& d) {
    const auto turn = static_cast<std::size_t>((std::atan2(d.y, d.x) / glm::two_pi<double>() + 0.5) * 7.9999);
    return 4 * turn + static_cast<std::size_t>(std::clamp(d.z, 0.0, 0.9999) * 4);
  };
  for (std::uint32_t i = 0; i < side; ++i)
    for (std::uint32_t j = 0; j < side; ++j) {
      const glm::dvec2 place((i + 0.5) / side, (j + 0.5) / side);
      const shared::SeenPoint there = shared::sample_seen_triangle(seen, corner, edge1, edge2, glm::vec2(place));
      if (!there.missed) found[cell(dvec3(there.direction))] += double(seen.angle) / (side * side);
      const double sine = std::sqrt(1 - place.x * place.x), turn = glm::two_pi<double>() * place.y;
      const dvec3 direction(sine * std::cos(turn), sine * std::sin(turn), place.x);
      if (meets(c, direction)) expected[cell(direction)] += glm::two_pi<double>() / (side * side);
    }
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 5e-3) << "cell " << i;
}
INSTANTIATE_TEST_SUITE_P(
    Sizes, SeenTriangle,
    testing::Values(Case{"speck", {0.1, 0.2, 1}, {1e-4, 0, 0}, {0, 2e-4, 0}, false},
                    Case{"panel", {-0.3, -0.2, 1}, {0.5, 0, 0.1}, {0, 0.6, 0}, false},
                    Case{"in_its_plane", {1, -1, 1e-12}, {0, 2, 0}, {3, 0, 0}, false},
                    Case{"from_its_corner", {0, 0, 0}, {1, 0, 1}, {0, 1, 1}, false},
                    Case{"near_panel", {-0.3, -0.2, 0.1}, {0.5, 0, 0.1}, {0, 0.6, 0}},
                    Case{"upright", {0.2, -1, 0.1}, {0, 2, 0}, {0, 0, 3}},
                    Case{"strip", {-1, -0.003, 0.02}, {2, 0, 0}, {2, 0.01, 0}},
                    Case{"beside_its_edge", {-500, -500, 0.1}, {1000, 0, 0}, {1000, 1000, 0}},
                    Case{"below_its_edge", {-500, 1e-3, 0.1}, {1000, 0, 0}, {0, 1000, 0}},
                    Case{"all_the_sky", {-500, -600, 0.1}, {1000, 0, 0}, {300, 2000, 0}},
                    Case{"askew", {-300, -500, 460.1}, {1000, 100, -300}, {-500, 900, -380}},
                    Case{"a_kilometre_a_millimetre_above", {-500, -500, 1e-3}, {1000, 0, 0}, {1000, 1000, 0}},
                    Case{"a_kilometre_a_micrometre_above", {-500, -600, 1e-6}, {1000, 0, 0}, {300, 2000, 0}}),
    [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace meniscal

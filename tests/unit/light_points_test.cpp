// Points on area lights: the sequence that they and the starts share, and the derivatives along them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "host/reference/differentials.h"
#include "host/reference/optics.h"
#include "shaders/shared/random.h"

namespace meniscal {
namespace {

using glm::dvec3;

// Coordinates of 2^bits points from `first`, in units of 2^-32.
std::vector<glm::uvec4> points(std::uint32_t first, std::uint32_t bits) {
  std::vector<glm::uvec4> points;
  for (std::uint32_t i = first; i < first + (1u << bits); ++i) {
    const shared::RandomKey key{7, 3, 1, i};
    points.push_back({shared::sobol_point(key), shared::sobol_point_beyond(key)});
  }
  return points;
}

// The most points in one cell of the grid of 2^a x 2^b cells.
int fullest_cell(const std::vector<glm::uvec4>& points, int x, int y, std::uint32_t a, std::uint32_t b) {
  std::vector<int> cells(std::size_t(1) << (a + b));
  for (const glm::uvec4& p : points) ++cells[std::uint64_t(p[x]) >> (32 - a) << b | std::uint64_t(p[y]) >> (32 - b)];
  return *std::max_element(cells.begin(), cells.end());
}

TEST(Sequence, IsStratifiedInEveryDimension) {
  for (int d = 0; d < 4; ++d) EXPECT_EQ(fullest_cell(points(512, 8), d, d == 0 ? 1 : 0, 8, 0), 1) << "dimension " << d;
}

TEST(Sequence, StartsAreANet) {
  for (std::uint32_t a = 0; a <= 10; ++a) EXPECT_EQ(fullest_cell(points(1024, 10), 0, 1, a, 10 - a), 1);
}

// Quality parameters t of the pairs of Sobol's first four dimensions: 2^t points a cell of a 2^(10 - t) grid.
TEST(Sequence, EveryPairIsEven) {
  for (int x = 0; x < 4; ++x)
    for (int y = x + 1; y < 4; ++y)
      for (std::uint32_t a = 0; a <= 7; ++a) EXPECT_EQ(fullest_cell(points(1024, 10), x, y, a, 7 - a), 8) << x << y;
}

TEST(Sequence, AllFourDimensionsTogetherAreEven) {
  std::vector<int> cells(256);
  for (const glm::uvec4& p : points(4096, 12)) ++cells[p.x >> 30 << 6 | p.y >> 30 << 4 | p.z >> 30 << 2 | p.w >> 30];
  for (int count : cells) EXPECT_EQ(count, 16);
}

// A spherical cap of water as seen by a path: a triangle with normals that differ, then a plane below.
struct Lens {
  WorldTriangle facet;
  dvec3 start{0.31e-3, 0, 0.24e-3}, lamp{0.02, 0.4, -0.03};
  dvec3 lamp_normal = glm::normalize(dvec3(0.2, -1, 0.1));
  double depth = 0.03, eta = 1 / 1.333;

  Lens() {
    facet.corner = {dvec3(0, 0, 0), dvec3(0, 0, 1e-3), dvec3(1e-3, 0, 0)};
    facet.geometric = dvec3(0, 1, 0);
    facet.area = 0.5e-6;
    for (int k = 0; k < 3; ++k) facet.normal[k] = glm::normalize(dvec3(0, 1, 0) + 120.0 * facet.corner[k]);
  }
  reference::Hit hit() const {
    const dvec3 normal = facet.normal[0] + start.z / 1e-3 * (facet.normal[1] - facet.normal[0]) +
                         start.x / 1e-3 * (facet.normal[2] - facet.normal[0]);
    return {0, 0, start, glm::normalize(normal)};
  }
  dvec3 landing(const dvec3& on_lamp) const {
    const dvec3 d = reference::refract(glm::normalize(start - on_lamp), hit().shading, eta);
    return start - depth / d.y * d;
  }
};

TEST(LightDifferential, AgreesWithFiniteDifferences) {
  const Lens lens;
  constexpr double extent = 0.05;
  const dvec3 arrival = glm::normalize(lens.start - lens.lamp);
  reference::Differential d =
      reference::light_differential(lens.lamp_normal, extent / glm::distance(lens.start, lens.lamp), arrival);
  const auto dn = reference::normal_differential(lens.facet, lens.hit(), d);
  const dvec3 leaving = reference::refract(arrival, lens.hit().shading, lens.eta);
  reference::refract(d, arrival, lens.hit().shading, dn, lens.eta);
  reference::transfer(d, leaving, -lens.depth / leaving.y, dvec3(0, 1, 0));
  const auto axes = reference::tangents(lens.lamp_normal);
  for (int i = 0; i < 2; ++i) {
    const dvec3 step = 1e-5 * axes[i];
    const dvec3 expected = extent * (lens.landing(lens.lamp + step) - lens.landing(lens.lamp - step)) / 2e-5;
    EXPECT_LT(glm::distance(d.place[i], expected), 1e-6 * glm::length(expected)) << "axis " << i;
  }
}

// Variances of the parts add up.
TEST(Footprint, SumsTheVariancesOfStartAndLight) {
  reference::Differential start, light;
  start.place = {dvec3(1, 0, 0), dvec3(0, 0, 0)};
  light.place = {dvec3(0, 0, 2), dvec3(1, 0, 0)};
  const reference::Footprint f = reference::make_footprint({{start, 3}, {light, 4}}, dvec3(0, 1, 0), 1e-3, 1e3);
  EXPECT_NEAR(1 / glm::length(f.alpha), 8, 1e-12);
  EXPECT_NEAR(std::abs(f.alpha.z), 1.0 / 8, 1e-12);
  EXPECT_NEAR(1 / glm::length(f.beta), 5, 1e-12);
}

}  // namespace
}  // namespace meniscal

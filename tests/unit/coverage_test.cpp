// Areas of polygons inside the unit square, as highlights are measured.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "host/reference/coverage.h"

namespace meniscal::reference {
namespace {

Coverage cover(const std::vector<glm::dvec2>& corners) {
  Coverage coverage;
  for (std::size_t i = 0; i < corners.size(); ++i) coverage.add_edge(corners[i], corners[(i + 1) % corners.size()]);
  return coverage;
}

TEST(Coverage, OfPolygonsOfKnownAreas) {
  const Coverage all = cover({{-3, -3}, {-3, 5}, {5, 5}, {5, -3}});
  EXPECT_DOUBLE_EQ(all.area(), 1);
  EXPECT_DOUBLE_EQ(all.centroid().x, 0.5);
  EXPECT_DOUBLE_EQ(all.centroid().y, 0.5);
  EXPECT_DOUBLE_EQ(cover({{0.25, 0.25}, {0.25, 0.5}, {0.75, 0.5}, {0.75, 0.25}}).area(), 0.125);
  EXPECT_NEAR(cover({{0, 0}, {0, 2}, {2, 0}}).area(), 1, 1e-15);
  EXPECT_NEAR(cover({{0, 0}, {0, 1}, {1, 0}}).area(), 0.5, 1e-15);
  EXPECT_NEAR(cover({{1.5, 0}, {1.5, 1}, {2.5, 0}}).area(), 0, 1e-15);
  EXPECT_NEAR(cover({{0, -1}, {1, -1}, {0.5, -0.1}}).area(), 0, 1e-15);
  // Thin and across: what a highlight is.
  EXPECT_NEAR(cover({{-1e6, 0.5}, {1e6, 0.501}, {1e6, 0.5}, {-1e6, 0.499}}).area(), 0.001, 1e-9);
}

// Two triangles that share an edge cover what their quadrilateral does: nothing twice, nothing left out.
TEST(Coverage, OfPartsIsThatOfTheWhole) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-2, 3);
  for (int i = 0; i < 1000; ++i) {
    std::vector<glm::dvec2> p;
    for (int k = 0; k < 3; ++k) p.emplace_back(place(random), place(random));
    const glm::dvec2 inner = (p[0] + 2.0 * p[1] + 3.0 * p[2]) / 6.0;
    double parts = 0;
    for (std::size_t k = 0; k < 3; ++k) parts += cover({p[k], p[(k + 1) % 3], inner}).area();
    EXPECT_NEAR(parts, cover(p).area(), 1e-12);
  }
}

// Against points on a grid, and their mean.
TEST(Coverage, IsThePartOfPointsInside) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> place(-1, 2);
  for (int i = 0; i < 50; ++i) {
    std::vector<glm::dvec2> p;
    for (int k = 0; k < 3; ++k) p.emplace_back(place(random), place(random));
    const int side = 400;
    glm::dvec2 sum(0);
    int inside = 0;
    for (int n = 0; n < side * side; ++n) {
      const glm::dvec2 q((n % side + 0.5) / side, (n / side + 0.5) / side);
      int left = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec2 a = p[(k + 1) % 3] - p[k], b = q - p[k];
        left += a.x * b.y - a.y * b.x > 0;
      }
      if (left % 3 == 0) ++inside, sum += q;
    }
    const Coverage coverage = cover(p);
    EXPECT_NEAR(coverage.area(), double(inside) / (side * side), 2e-3);
    if (inside < side * side / 50) continue;
    EXPECT_NEAR(coverage.centroid().x, sum.x / inside, 2e-2);
    EXPECT_NEAR(coverage.centroid().y, sum.y / inside, 2e-2);
  }
}

}  // namespace
}  // namespace meniscal::reference

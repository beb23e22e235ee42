// Where two menisci, or two parts of one, meet: the surface's edges follow the crease between them.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "meniscus/meniscus.h"
#include "meniscus/tree.h"
#include "tests/unit/meniscus_shapes.h"

using namespace shapes;
using glm::dvec2;
using glm::dvec3;
using meniscus::Surface;

namespace {

constexpr double kSweep = 2 * kWater;

// How far a point of the liquid is from a wall, in plan; metres.
using Distance = std::function<double(const dvec2&)>;
Distance from_circle(const dvec2& centre, double radius) {
  return [=](const dvec2& x) { return glm::distance(x, centre) - radius; };
}
Distance from_line(const dvec2& point, const dvec2& normal) {
  return [=](const dvec2& x) { return glm::dot(x - point, normal); };
}

struct Strays {
  std::size_t crossing = 0, along = 0;  // edges from one wall's side to another's; edges on the creases
  dvec2 example{};
};

// Looks at edges of menisci whose ends lie beside the walls: nearest to one of them, or to two alike.
Strays find_strays(const Surface& surface, const std::vector<Distance>& walls) {
  constexpr double kMargin = 5e-3 * kMm;
  const auto side = [&](const dvec3& p) {  // -1 on a crease
    std::vector<std::pair<double, int>> d;
    for (std::size_t i = 0; i < walls.size(); ++i) d.emplace_back(walls[i]({p.x, p.z}), static_cast<int>(i));
    std::sort(d.begin(), d.end());
    if (d[0].first > 0.97 * kSweep) return -2;
    return d[1].first - d[0].first < kMargin ? -1 : d[0].second;
  };
  Strays result;
  const auto& p = surface.mesh.positions;
  for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
    if (!surface.meniscus[t]) continue;
    for (int k = 0; k < 3; ++k) {
      const dvec3 a = p[surface.mesh.triangles[t][k]], b = p[surface.mesh.triangles[t][(k + 1) % 3]];
      const int i = side(a), j = side(b);
      result.along += i == -1 && j == -1;
      if (i < 0 || j < 0 || i == j) continue;
      ++result.crossing;
      result.example = {a.x / kMm, a.z / kMm};
    }
  }
  return result;
}

TriangleMesh standing(double radius, double x, double z) {
  return translated(post(radius * kMm, -50 * kMm, 10 * kMm, 256), {x * kMm, 0, z * kMm});
}
TriangleMesh wall(double x0, double z0, double x1, double z1) {
  return box({x0 * kMm, -10 * kMm, z0 * kMm}, {x1 * kMm, 10 * kMm, z1 * kMm});
}
dvec2 mm(double x, double z) { return kMm * dvec2(x, z); }

void expect_edges_on_creases(const std::vector<TriangleMesh>& solids, const std::vector<Distance>& walls) {
  meniscus::Liquid liquid = water(sheet(40 * kMm, 1));
  std::vector<meniscus::Solid> all;
  for (const TriangleMesh& mesh : solids) all.push_back(solid(mesh, 30, "solid " + std::to_string(all.size())));
  const Strays strays = find_strays(build(liquid, all), walls);
  EXPECT_GE(strays.along, 20u);
  EXPECT_EQ(strays.crossing, 0u) << "edges cross a crease, as at (" << strays.example.x << ", " << strays.example.y
                                 << ") mm";
}

TEST(Crease, EdgesFollowItBetweenTwoPosts) {
  for (const double x : {2.1, 2.5, 3.5, 5.0}) {
    expect_edges_on_creases({standing(2, -x, 0), standing(2, x, 0)},
                            {from_circle(mm(-x, 0), 2 * kMm), from_circle(mm(x, 0), 2 * kMm)});
  }
}

TEST(Crease, EdgesFollowItBetweenUnequalPosts) {
  expect_edges_on_creases({standing(3, -3.5, 0), standing(0.3, 2, 1)},
                          {from_circle(mm(-3.5, 0), 3 * kMm), from_circle(mm(2, 1), 0.3 * kMm)});
}

TEST(Crease, EdgesFollowThoseOfThreePosts) {
  expect_edges_on_creases(
      {standing(2, -3, 0), standing(2, 3, 0.3), standing(1, 0.2, 4)},
      {from_circle(mm(-3, 0), 2 * kMm), from_circle(mm(3, 0.3), 2 * kMm), from_circle(mm(0.2, 4), 1 * kMm)});
}

TEST(Crease, EdgesFollowItBetweenAPostAndAWall) {
  expect_edges_on_creases({standing(1, 0, 0), wall(-30, -8, 30, -3)},
                          {from_circle(mm(0, 0), kMm), from_line(mm(0, -3), {0, 1})});
}

TEST(Crease, EdgesFollowItFromACorner) {
  // Two walls as one prism: a line that meets itself.
  const std::vector<dvec2> corner{mm(-20, -20), mm(20, -20), mm(20, -10), mm(-10, -10), mm(-10, 20), mm(-20, 20)};
  expect_edges_on_creases({prism(corner, -10 * kMm, 10 * kMm)},
                          {from_line(mm(-10, 0), {1, 0}), from_line(mm(0, -10), {0, 1})});
}

// The paper's profile has two slopes there: each side's triangles end with their own.
TEST(Crease, EachSideHasItsOwnNormals) {
  const Surface surface =
      build(water(sheet(40 * kMm, 1)), {solid(standing(2, -3.5, 0), 30, "a"), solid(standing(2, 3.5, 0), 30, "b")});
  const auto& p = surface.mesh.positions;
  double worst = 0;
  for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
    const glm::uvec3 v = surface.mesh.triangles[t];
    if (!surface.meniscus[t]) continue;
    const double post = std::copysign(3.5 * kMm, p[v.x].x + p[v.y].x + p[v.z].x);
    for (int k = 0; k < 3; ++k) {
      const dvec2 way{p[v[k]].x - post, p[v[k]].z};
      const double r = glm::length(way), d = (r - 2 * kMm) / kSweep;
      if (d > 0.99) continue;
      const double slope = glm::half_pi<double>() / 3 * std::cos(glm::half_pi<double>() * std::max(d, 0.0));
      const dvec3 n = glm::normalize(dvec3(slope * way.x / r, 1, slope * way.y / r));
      worst = std::max(worst, glm::distance(n, surface.mesh.normals[v[k]]));
    }
  }
  EXPECT_LT(worst, 1e-3);
}

// Rods side by side: what lies between two of them slides along with both.
TEST(Crease, MenisciThatSlideAlikeLeaveEachOtherRoom) {
  for (const auto& [degrees, gap] : {std::pair(15, 0.8), std::pair(15, 1.2), std::pair(15, 1.8), std::pair(30, 2.2)}) {
    constexpr double kRadius = 0.4;
    std::vector<meniscus::Solid> rods;
    for (const int k : {-1, 0, 1}) {
      const TriangleMesh rod = turned(post(kRadius * kMm, -50 * kMm, 50 * kMm, 64), degrees, {0, 0, -1});
      rods.push_back(solid(translated(rod, {k * (gap + 2 * kRadius) * kMm, 0, 0}), 30, "rod " + std::to_string(k)));
    }
    const Surface surface = build(water(sheet(40 * kMm, 1)), rods);
    for (const std::string& warning : surface.warnings) ADD_FAILURE() << warning << ": " << degrees << " deg, " << gap;
  }
}

// Where vertical lines meet the surface.
class Heights {
 public:
  explicit Heights(const meniscus::TriangleMesh& mesh) : mesh_(mesh), tree_(boxes(mesh)) {}
  double at(const dvec2& x) const {
    double height = -1;
    meniscus::Box line;
    line.add({x.x, -1, x.y});
    line.add({x.x, 1, x.y});
    tree_.overlapping(line, [&](std::uint32_t t) {
      const auto corner = [&](int k) { return mesh_.positions[mesh_.triangles[t][k]]; };
      const dvec3 a = corner(0), n = glm::cross(corner(1) - a, corner(2) - a);
      for (int k = 0; k < 3; ++k)
        if (glm::cross(corner((k + 1) % 3) - corner(k), dvec3(x.x, 0, x.y) - corner(k)).y < -1e-15) return;
      height = a.y - ((x.x - a.x) * n.x + (x.y - a.z) * n.z) / n.y;
    });
    return height;
  }

 private:
  static std::vector<meniscus::Box> boxes(const meniscus::TriangleMesh& mesh) {
    std::vector<meniscus::Box> result(mesh.triangles.size());
    for (std::size_t t = 0; t < result.size(); ++t)
      for (int k = 0; k < 3; ++k) result[t].add(mesh.positions[mesh.triangles[t][k]]);
    return result;
  }
  const meniscus::TriangleMesh& mesh_;
  meniscus::Tree tree_;
};

// The crease between equal posts is their plane of symmetry, and neither has more of it than the other.
TEST(Crease, EqualPostsHaveMirroredMenisci) {
  const Surface surface =
      build(water(sheet(40 * kMm, 1)), {solid(standing(2, -3.5, 0), 30, "a"), solid(standing(2, 3.5, 0), 30, "b")});
  const Heights heights(surface.mesh);
  double worst = 0;
  for (double x = 0.01; x < 1.4; x += 0.02) {
    for (double z = -4; z < 4; z += 0.037) {
      worst = std::max(worst, std::abs(heights.at(mm(x, z)) - heights.at(mm(-x, z))));
    }
  }
  EXPECT_LT(worst, 1e-6) << "metres";
}

}  // namespace

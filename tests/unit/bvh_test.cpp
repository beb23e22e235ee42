// The hierarchy against brute force, and its promises: containment, bounds on leaves and depth, one tree for one input.
#include <cstring>
#include <random>

#include "bvh_oracle.h"
#include "host/error.h"

namespace meniscal {
namespace {

using namespace bvh_oracle;

using Random = std::mt19937_64;
double uniform(Random& random) { return std::uniform_real_distribution<double>(-1, 1)(random); }
glm::dvec3 point(Random& random) { return {uniform(random), uniform(random), uniform(random)}; }

Ray random_ray(Random& random, double distance = 2) {
  const glm::dvec3 origin = distance * point(random);
  return {glm::vec3(origin), glm::vec3(glm::normalize(point(random) - origin))};
}

std::vector<Triangle> soup(size_t n, double size, uint64_t seed) {
  Random random(seed);
  std::vector<Triangle> triangles;
  for (size_t i = 0; i < n; ++i) {
    const glm::dvec3 centre = point(random);
    triangles.push_back({centre + size * point(random), centre + size * point(random), centre + size * point(random)});
  }
  return triangles;
}

// Long and thin, some across the whole scene, some of no area at all.
std::vector<Triangle> slivers(size_t n, uint64_t seed) {
  Random random(seed);
  std::vector<Triangle> triangles;
  for (size_t i = 0; i < n; ++i) {
    const glm::dvec3 a = point(random), b = point(random);
    triangles.push_back(
        {a, b, b + (i % 10 == 0 ? 0.0 : std::pow(10.0, -1 - static_cast<double>(i % 6))) * point(random)});
  }
  return triangles;
}

// A rippled sheet: what a liquid's surface looks like.
std::vector<Triangle> sheet(int n) {
  const auto vertex = [&](int i, int j) {
    const double x = 2.0 * i / n - 1, z = 2.0 * j / n - 1;
    return glm::dvec3(x, 0.05 * std::sin(9 * x) * std::cos(7 * z), z);
  };
  std::vector<Triangle> triangles;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      triangles.push_back({vertex(i, j), vertex(i, j + 1), vertex(i + 1, j)});
      triangles.push_back({vertex(i + 1, j), vertex(i, j + 1), vertex(i + 1, j + 1)});
    }
  }
  return triangles;
}

void expect_brute_force(const std::vector<Triangle>& triangles, int rays, uint64_t seed,
                        uint32_t max_depth = shared::BVH_MAX_DEPTH) {
  const Bvh bvh = build_bvh(triangles, max_depth);
  check_tree(bvh, triangles);
  Random random(seed);
  int hits = 0;
  for (int i = 0; i < rays; ++i) {
    const Ray ray = random_ray(random, i % 2 == 0 ? 2 : 0.5);
    const auto expected = brute_force(triangles, ray);
    const auto found = traverse(bvh, triangles, ray);
    hits += expected.has_value();
    ASSERT_EQ(expected.has_value(), found.has_value()) << "ray " << i;
    if (!expected) continue;
    ASSERT_EQ(*expected, *found) << "ray " << i << ": t " << expected->t << " and " << found->t;
  }
  EXPECT_GT(hits, 0) << "rays that hit nothing test nothing";
}

TEST(Bvh, AgreesWithBruteForceOnRandomTriangles) { expect_brute_force(soup(3000, 0.05, 1), 4000, 2); }
TEST(Bvh, AgreesWithBruteForceOnOverlappingTriangles) { expect_brute_force(soup(300, 1, 3), 4000, 4); }
TEST(Bvh, AgreesWithBruteForceOnSlivers) { expect_brute_force(slivers(2000, 5), 4000, 6); }
TEST(Bvh, AgreesWithBruteForceOnASheet) { expect_brute_force(sheet(30), 4000, 7); }
TEST(Bvh, AgreesWithBruteForceFarFromTheOrigin) {
  auto triangles = soup(1000, 0.05, 8);
  for (Triangle& t : triangles) {
    for (glm::dvec3* p : {&t.a, &t.b, &t.c}) *p += glm::dvec3(500, -300, 0.001);
  }
  const Bvh bvh = build_bvh(triangles);
  check_tree(bvh, triangles);
  Random random(9);
  for (int i = 0; i < 2000; ++i) {
    Ray ray = random_ray(random);
    ray.origin += glm::vec3(500, -300, 0.001f);
    ASSERT_EQ(brute_force(triangles, ray), traverse(bvh, triangles, ray)) << "ray " << i;
  }
}

// Light from straight above, on the grid's own lines too: no direction to divide by.
TEST(Bvh, AgreesWithBruteForceOnVerticalRays) {
  const auto triangles = sheet(20);
  const Bvh bvh = build_bvh(triangles);
  int hits = 0;
  for (int i = -42; i <= 42; ++i) {
    for (int j = -42; j <= 42; ++j) {
      const Ray ray{{0.025f * static_cast<float>(i), 1, 0.025f * static_cast<float>(j)}, {0, -1, 0}};
      const auto expected = brute_force(triangles, ray);
      ASSERT_EQ(expected, traverse(bvh, triangles, ray)) << i << " " << j;
      hits += expected.has_value();
    }
  }
  EXPECT_GT(hits, 81 * 81 / 2);
}

TEST(Bvh, HalvesWhereLevelsRunShort) {
  const auto triangles = soup(3000, 0.05, 10);
  ASSERT_GT(build_bvh(triangles).depth, 10u);
  expect_brute_force(triangles, 1000, 11, 10);
  EXPECT_EQ(build_bvh(triangles, 10).depth, 10u);  // 3000 triangles in leaves of at most 4: 1024 leaves, 10 levels
}

TEST(Bvh, HoldsNoTriangle) {
  const Bvh bvh = build_bvh({});
  ASSERT_EQ(bvh.nodes.size(), 1u);
  Random random(12);
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(traverse(bvh, {}, random_ray(random)));
}

TEST(Bvh, HoldsFewTriangles) {
  for (size_t n = 1; n <= 9; ++n) expect_brute_force(soup(n, 3, n), 1000, n);
}

TEST(Bvh, HoldsCoincidentTriangles) {
  std::vector<Triangle> triangles(20000, Triangle{{-1, 0, -1}, {1, 0, -1}, {0, 0, 1}});
  const Bvh bvh = build_bvh(triangles);
  check_tree(bvh, triangles);
  EXPECT_EQ(traverse(bvh, triangles, {{0, 1, 0}, glm::normalize(glm::vec3(0.01f, -1, 0.01f))})->triangle, 0u);
}

TEST(Bvh, HoldsPointsAndLines) {
  Random random(13);
  auto triangles = soup(500, 0.2, 14);
  for (int i = 0; i < 3000; ++i) {
    const glm::dvec3 a = point(random);
    triangles.push_back(i % 3 == 0 ? Triangle{a, a, a} : Triangle{a, 2.0 * a, 3.0 * a});
    if (i % 3 == 1) triangles.push_back({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
  }
  expect_brute_force(triangles, 1000, 15);
}

// Each a fraction of the one before: a heuristic splits off one at a time.
TEST(Bvh, BoundsTheDepthOfNestedScales) {
  std::vector<Triangle> triangles;
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < 400; ++i) {
      const double scale = std::pow(0.9, i);
      glm::dvec3 shift(0);
      shift[axis] = scale;
      triangles.push_back({shift, shift + glm::dvec3(0.01 * scale), shift + glm::dvec3(0, 0.01 * scale, 0)});
    }
  }
  check_tree(build_bvh(triangles), triangles);
  check_tree(build_bvh(triangles, 16), triangles);
}

TEST(Bvh, IsTheSameTreeEachTime) {
  const auto triangles = soup(50000, 0.02, 16);
  const Bvh first = build_bvh(triangles), second = build_bvh(triangles);
  EXPECT_EQ(first.order, second.order);
  ASSERT_EQ(first.nodes.size(), second.nodes.size());
  EXPECT_EQ(std::memcmp(first.nodes.data(), second.nodes.data(), first.nodes.size() * sizeof(BvhNode)), 0);
  EXPECT_EQ(first.sah_cost, second.sah_cost);
}

// The cost is what lines visit that nothing stops, on average: a wrong one shows.
TEST(Bvh, CostForetellsWhatLinesVisit) {
  const auto triangles = slivers(3000, 18);
  const Bvh bvh = build_bvh(triangles);
  const BvhNode& root = bvh.nodes[0];
  const glm::dvec3 scene_low = glm::min(low(root, 0), low(root, 1)),
                   scene_high = glm::max(high(root, 0), high(root, 1));
  const std::vector<Triangle> nothing(triangles.size());  // points at the origin, in the tree of the others
  Random random(19);
  std::normal_distribution<double> normal;
  Counts counts;
  size_t lines = 0;
  while (lines < 10000) {
    // Lines of uniform direction and uniform offset across it: a box is met with probability in proportion to its area.
    const glm::dvec3 d = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    const glm::dvec3 x = glm::normalize(glm::cross(d, std::abs(d.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    const Ray ray{glm::vec3(2 * uniform(random) * x + 2 * uniform(random) * glm::cross(d, x) - 4.0 * d), glm::vec3(d)};
    if (!enter_box(glm::vec3(0.5 * (scene_low + scene_high)), glm::vec3(0.5 * (scene_high - scene_low)), ray, 1e30f))
      continue;
    ++lines;
    traverse(bvh, nothing, ray, &counts);
  }
  const double visited = static_cast<double>(counts.nodes + counts.triangles) / static_cast<double>(lines);
  EXPECT_NEAR(visited / bvh.sah_cost, 1, 0.02) << visited << " visited, " << bvh.sah_cost << " foretold";
}

TEST(Bvh, RefusesWhatIsNotANumber) {
  auto triangles = soup(10, 1, 20);
  for (const double bad : {std::nan(""), HUGE_VAL, 1e38}) {
    triangles[7].b.y = bad;
    try {
      build_bvh(triangles);
      FAIL() << "accepted " << bad;
    } catch (const Error& error) {
      EXPECT_EQ(error.code, ExitCode::scene);
      EXPECT_NE(std::string(error.what()).find("triangle 7"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace meniscal

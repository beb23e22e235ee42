// The exact meniscus, solved on the mesh: profiles, contact lines round shapes of any kind, and what must not matter.
#include <algorithm>
#include <optional>

#include "meniscus/lift.h"
#include "meniscus/young_laplace.h"
#include "tests/unit/meniscus_solved.h"

using namespace solved;
using glm::dvec2;
using glm::dvec3;

namespace {

// Height and unit normal of a surface that is a graph, above (x, z).
std::optional<meniscus::Lifted> above(const meniscus::Surface& surface, const dvec2& at) {
  const meniscus::TriangleMesh& mesh = surface.mesh;
  for (const glm::uvec3& t : mesh.triangles) {
    const dvec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
    const double whole = (b.z - a.z) * (c.x - a.x) - (b.x - a.x) * (c.z - a.z);
    const double v = ((at.y - a.z) * (c.x - a.x) - (at.x - a.x) * (c.z - a.z)) / whole;
    const double w = ((b.z - a.z) * (at.x - a.x) - (b.x - a.x) * (at.y - a.z)) / whole;
    if (!(v >= 0 && w >= 0 && v + w <= 1)) continue;
    const dvec3 normal = (1 - v - w) * mesh.normals[t.x] + v * mesh.normals[t.y] + w * mesh.normals[t.z];
    return meniscus::Lifted{(1 - v - w) * a + v * b + w * c, glm::normalize(normal)};
  }
  return std::nullopt;
}

// Heights and slopes of profiles.csv at so far from the wall in these directions, from points on the wall.
struct Ray {
  dvec2 wall, way;
};
void expect_profile(const meniscus::Surface& surface, const std::string& radius, const std::string& theta,
                    const std::vector<Ray>& rays) {
  SCOPED_TRACE("radius " + radius + ", theta " + theta);
  double height = 0;  // of the contact line
  int checked = 0;
  for (const Row& row : table("profiles.csv")) {
    if (row.at("R_mm") != radius || row.at("theta") != theta) continue;
    const double distance = number(row, "dist_from_wall_mm"), expected = number(row, "h_mm");
    if (distance == 0) {
      height = std::abs(expected);
      continue;
    }
    for (const Ray& ray : rays) {
      const auto found = above(surface, ray.wall + distance * kMm * ray.way);
      if (!found) continue;
      ++checked;
      const dvec3& n = found->normal;
      const double slope = glm::degrees(-std::atan2(n.x * ray.way.x + n.z * ray.way.y, n.y));
      EXPECT_NEAR(found->position.y / kMm, expected, 2e-3 * height) << distance;
      if (distance > 0.05) {
        EXPECT_NEAR(slope, number(row, "slope_deg"), 0.3) << distance;
      }
    }
  }
  EXPECT_GE(checked, 15 * static_cast<int>(rays.size()));
}

void check_profile(const std::string& radius, const std::string& theta) {
  const double wide = std::stod(radius) * kMm;
  std::vector<Ray> rays;
  for (int k = 0; k < 6; ++k) {
    const double a = 0.03 + 1.04 * k;
    const dvec2 way(std::sin(a), std::cos(a));
    rays.push_back({wide * way, way});
  }
  expect_profile(solve_post(wide, std::stod(theta)), radius, theta, rays);
}

TEST(SolvedProfile, OfPostsIsThatOfTheTable) {
  check_profile("0.5", "60");
  check_profile("2", "30");
}

TEST(SolvedProfile, SlowOfAllPostsIsThatOfTheTable) {
  for (const char* radius : {"0.035", "0.5", "2", "10"})
    for (const char* theta : {"0", "30", "60", "120", "180"}) check_profile(radius, theta);
}

// On solid(p), of the mesh's edges there the height nearest to each row's point.
void expect_contact_line(const meniscus::Surface& surface, const std::string& name,
                         const std::function<double(dvec2)>& solid) {
  const meniscus::TriangleMesh& mesh = surface.mesh;
  std::vector<std::pair<dvec3, dvec3>> edges;
  for (const glm::uvec3& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const dvec3 a = mesh.positions[t[k]], b = mesh.positions[t[(k + 1) % 3]];
      if (std::abs(solid({a.x, a.z})) < 2e-3 && std::abs(solid({b.x, b.z})) < 2e-3) edges.emplace_back(a, b);
    }
  }
  ASSERT_GT(edges.size(), 60u);
  for (const Row& row : table(name)) {
    const dvec2 p = kMm * dvec2(number(row, "x_mm"), number(row, "y_mm"));
    double nearest = 1e300, height = 0;
    for (const auto& [a, b] : edges) {
      const dvec2 from(a.x, a.z), way = dvec2(b.x, b.z) - from;
      const double t = std::clamp(glm::dot(p - from, way) / glm::dot(way, way), 0.0, 1.0);
      const double distance = glm::distance(p, from + t * way);
      if (distance < nearest) nearest = distance, height = a.y + t * (b.y - a.y);
    }
    EXPECT_LT(nearest, 0.02 * kMm);
    EXPECT_NEAR(height / kMm / number(row, "h_mm"), 1, 0.01) << "at " << row.at("azimuth_deg") << " degrees";
  }
}

TEST(SolvedContactLine, OnAnEllipticPostIsThatOfSurfaceEvolver) {
  TriangleMesh ellipse = post(1, -20 * kMm, 20 * kMm, 512);
  for (dvec3& p : ellipse.positions) p.x *= 4 * kMm, p.z *= 1.5 * kMm;
  for (dvec3& n : ellipse.normals) n = glm::normalize(dvec3(n.x / 4, n.y, n.z / 1.5));
  expect_contact_line(solve(still_water(sheet(40 * kMm, 40)), {solid(ellipse, 30)}), "evolver_ellipse_contact.csv",
                      [](dvec2 p) { return glm::length(p / dvec2(4 * kMm, 1.5 * kMm)) - 1; });
}

std::vector<meniscus::Solid> two_posts() {
  const TriangleMesh one = post(2 * kMm, -20 * kMm, 20 * kMm, 256);
  return {solid(translated(one, {-2.5 * kMm, 0, 0}), 30, "left"),
          solid(translated(one, {2.5 * kMm, 0, 0}), 30, "right")};
}

TEST(SolvedContactLine, OnTwoPostsIsThatOfSurfaceEvolver) {
  const meniscus::Surface surface = solve(still_water(sheet(40 * kMm, 40)), two_posts());
  EXPECT_EQ(surface.solution.parts, 1u);
  expect_contact_line(surface, "evolver_two_contact.csv",
                      [](dvec2 p) { return glm::distance(p, dvec2(2.5 * kMm, 0)) / (2 * kMm) - 1; });
}

TEST(SolvedContactLine, OnASquarePostIsLowAtItsEdges) {
  const double half = 2 * kMm;
  const meniscus::Surface surface =
      solve(still_water(sheet(40 * kMm, 40)), {solid(box({-half, -20 * kMm, -half}, {half, 20 * kMm, half}), 30)});
  ASSERT_EQ(surface.contacts.size(), 1u);
  EXPECT_NEAR(surface.contacts[0].rise_min / kMm, 1.600, 0.01 * 1.600);
  EXPECT_NEAR(surface.contacts[0].rise_max / kMm, 2.184, 0.01 * 2.184);
}

// Heights in mm; to 1 %, of 1 mm where they are less.
void check_tilted(double theta, double low, double high) {
  SCOPED_TRACE(theta);
  const TriangleMesh straight = revolve([](double) { return 2 * kMm; }, -20 * kMm, 20 * kMm, 256, 64);
  const meniscus::Surface surface =
      solve(still_water(sheet(40 * kMm, 40)), {solid(turned(straight, 45, {0, 0, 1}), theta)});
  ASSERT_EQ(surface.contacts.size(), 1u);
  EXPECT_NEAR(surface.contacts[0].rise_min / kMm, low, 0.01 * std::max(1.0, std::abs(low)));
  EXPECT_NEAR(surface.contacts[0].rise_max / kMm, high, 0.01 * std::max(1.0, std::abs(high)));
}

TEST(SolvedContactLine, OnATiltedPostIsThatOfAFineSolution) {
  check_tilted(60, -0.198, 1.879);
  check_tilted(30, 0.623, 2.61);
}

// Round a sphere the liquid hangs as round a post that is as wide where they meet, at the sphere's slant there.
double rise_at_sphere(double radius, double centre, double theta, double low, double high) {
  const auto missing = [&](double height) {
    const double cosine = (height - centre) / radius, across = radius * std::sqrt(1 - cosine * cosine);
    return kWater * meniscus::exact_rise(std::acos(cosine) - glm::radians(theta), kWater / across) - height;
  };
  EXPECT_LT(missing(low) * missing(high), 0);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (missing(low) * missing(middle) <= 0 ? high : low) = middle;
  }
  return low;
}

TEST(SolvedContactLine, OnSpheresThatHardlyMeetTheLiquidIsYoungLaplaces) {
  struct Case {
    double radius, centre, theta, rise;  // mm, degrees; about
  };
  for (const Case& c : {Case{2, 1.9, 30, 1.8}, {2, 1.99, 100, 0.77}, {2, -1, 0, 0.72}, {2, -1.9, 90, -0.88}}) {
    SCOPED_TRACE(c.centre);
    const TriangleMesh ball = translated(sphere(c.radius * kMm, 128, 64), {0, c.centre * kMm, 0});
    const meniscus::Surface surface = solve(still_water(sheet(30 * kMm, 40)), {solid(ball, c.theta)});
    ASSERT_EQ(surface.contacts.size(), 1u);
    const double a = 0.95 * c.rise * kMm, b = 1.05 * c.rise * kMm;
    expect_rise(surface.contacts[0],
                rise_at_sphere(c.radius * kMm, c.centre * kMm, c.theta, std::min(a, b), std::max(a, b)), 2e-3);
  }
}

// Its sides have long left the vertical planes in which they were met.
TEST(SolvedContactLine, FollowsALeaningNeedleMuchThinnerThanItRises) {
  const TriangleMesh needle = turned(post(0.02 * kMm, -5 * kMm, 5 * kMm, 64), 30, {0, 0, 1});
  const meniscus::Surface surface = solve(still_water(sheet(30 * kMm, 40)), {solid(needle, 30)});
  ASSERT_EQ(surface.contacts.size(), 1u);
  EXPECT_GT(surface.contacts[0].rise_min, 0.05 * kMm);
  for (const dvec3& p : surface.mesh.positions) EXPECT_FALSE(std::isnan(p.y));
}

}  // namespace

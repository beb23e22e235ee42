// The exact meniscus, solved, where angles, sizes, places and corners are extreme.
#include <algorithm>

#include "meniscus/young_laplace.h"
#include "tests/unit/meniscus_solved.h"

using namespace solved;
using glm::dvec3;

namespace {

constexpr double kPrecise = 2e-3;  // relative
constexpr double kGrazing = 1e-2;  // where the surface touches the wall along a tangent
constexpr double kCoarse = 16;     // tolerance, where shapes rather than figures are checked: a quarter of the mesh

meniscus::Surface solve_vertical(double radius, double degrees, double capillary_length, double border) {
  const double half = 10 * std::max(capillary_length, 1 * kMm);
  meniscus::Liquid liquid = still_water(sheet(border, 40));
  liquid.capillary_length = capillary_length;
  return solve(liquid, {solid(post(radius, -half, half, 256), degrees)});
}

bool warns(const meniscus::Surface& surface, const std::string& of) {
  return std::any_of(surface.warnings.begin(), surface.warnings.end(),
                     [&](const std::string& warning) { return warning.find(of) != std::string::npos; });
}

double lowest(const meniscus::Surface& surface) {
  double least = 1e300;
  for (const dvec3& p : surface.mesh.positions) least = std::min(least, p.y);
  return least;
}

// Where a solid of revolution about +Y is met from outside: its radius and slope through the liquid at each height.
struct Outline {
  std::function<double(double)> radius, beta;
};
double rise_at(const Outline& outline, double theta, double low, double high) {
  for (int i = 0; i < 60; ++i) {
    const double h = 0.5 * (low + high);
    const double asked =
        kWater * meniscus::exact_rise(outline.beta(h) - glm::radians(theta), kWater / outline.radius(h));
    (asked > h ? low : high) = h;
  }
  return low;
}
Outline ball(double radius, double centre) {
  return {[=](double h) { return std::sqrt(radius * radius - (h - centre) * (h - centre)); },
          [=](double h) { return std::acos((h - centre) / radius); }};
}

TEST(SolvedAngle, Of0And180TouchesAPostAlongIt) {
  for (const double theta : {0.0, 180.0}) {
    const meniscus::Surface surface = solve_post(2 * kMm, theta);
    const double exact = kWater * meniscus::exact_rise(glm::radians(90 - theta), kWater / (2 * kMm));
    expect_rise(surface.contacts.at(0), exact, kGrazing);
    for (const dvec3& p : surface.mesh.positions) ASSERT_TRUE(std::isfinite(p.x + p.y + p.z));
    int on_line = 0;
    for (std::size_t v = 0; v < surface.mesh.positions.size(); ++v) {
      const dvec3 p = surface.mesh.positions[v], n = surface.mesh.normals[v];
      ASSERT_NEAR(glm::length(n), 1, 1e-6);
      if (std::abs(p.y) < 0.9 * std::abs(exact) || std::hypot(p.x, p.z) > 2.0005 * kMm) continue;
      EXPECT_LT(std::abs(n.y), 1e-3) << theta;
      ++on_line;
    }
    EXPECT_GT(on_line, 60);
  }
}

TEST(SolvedAngle, AMillionthOfADegreeBesideALimitIsAsGoodAsThere) {
  const auto rise = [](double theta) { return solve_post(2 * kMm, theta, kCoarse).contacts.at(0).rise_max; };
  EXPECT_NEAR(rise(1e-6) / rise(0), 1, 1e-6);
  EXPECT_NEAR(rise(180 - 1e-6) / rise(180), 1, 1e-6);
  const double exact = kWater * meniscus::exact_rise(glm::radians(1e-6), kWater / (2 * kMm));
  EXPECT_NEAR(rise(90 - 1e-6) / exact, 1, 0.02);
  EXPECT_NEAR(rise(90 + 1e-6) / -exact, 1, 0.02);
}

TEST(SolvedAngle, IsMirroredAtTheLevel) {
  for (const double theta : {0.0, 30.0, 75.0}) {
    const meniscus::Surface up = solve_post(2 * kMm, theta, kCoarse), down = solve_post(2 * kMm, 180 - theta, kCoarse);
    EXPECT_NEAR(up.contacts.at(0).rise_max / -down.contacts.at(0).rise_min, 1, 1e-6) << theta;
    EXPECT_NEAR(lowest(down) / down.contacts.at(0).rise_min, 1, 1e-3) << theta;
    EXPECT_GE(lowest(up), -1e-6 * kWater) << theta;
  }
}

TEST(SolvedRise, OfAHairIsAFiftiethOfAFlatWalls) {
  expect_rise(solve_post(0.035 * kMm, 0).contacts.at(0), 0.18076 * kMm, kPrecise);
}

TEST(SolvedRise, OfAPostOfMicrometresIsExact) {
  const double radius = 2e-6;
  expect_rise(solve_post(radius, 30).contacts.at(0), kWater * meniscus::exact_rise(glm::radians(60.0), kWater / radius),
              kPrecise);
}

TEST(SolvedRise, OfMercuryIsADepression) {
  const double length = std::sqrt(0.4855 / (13546 * 9.80665));
  expect_rise(solve_vertical(2 * kMm, 140, length, 25 * kMm).contacts.at(0), -1.148 * kMm, kPrecise);
}

TEST(SolvedRise, InAThousandthOfGravityIsHigh) {
  const double length = std::sqrt(0.0728 / (998.2 * 9.80665e-3));
  expect_rise(solve_vertical(2 * kMm, 30, length, 10 * length).contacts.at(0), 7.22 * kMm, kPrecise);
}

TEST(SolvedRise, SlowOfAPostAHundredCapillaryLengthsWideIsShortOfAFlatWalls) {
  const double radius = 100 * kWater, flat = 2 * kWater * std::sin(glm::radians(30.0));
  const meniscus::Surface surface =
      solve(still_water(sheet(1.1 * radius, 40)), {solid(post(radius, -10 * kWater, 10 * kWater, 1024), 30)});
  expect_rise(surface.contacts.at(0), kWater * meniscus::exact_rise(glm::radians(60.0), 0.01), kPrecise);
  EXPECT_LT(surface.contacts.at(0).rise_max, (1 - 0.003) * flat);
}

// The hair stands in the wall's meniscus.
TEST(SolvedRise, SlowOfAHairBesideAWallOfTenMetresIsThatBesideAShorterWall) {
  const auto hair = [](double half) {
    const meniscus::Surface surface =
        solve(still_water(translated(rectangle(half, half, 20), {0.98 * half, 0, 0}), kCoarse),
              {solid(box({-half, -half, -1.1 * half}, {0, half, 1.1 * half}), 30, "wall"),
               solid(translated(post(0.035 * kMm, -20 * kMm, 20 * kMm, 256), {2 * kMm, 0, 0}), 30, "hair")});
    EXPECT_EQ(surface.contacts.size(), 2u);
    return surface.contacts[surface.contacts[0].solid == "hair" ? 0 : 1];
  };
  const meniscus::Contact beside_long = hair(5), beside_short = hair(30 * kMm);
  EXPECT_NEAR(beside_long.rise_min / beside_short.rise_min, 1, 5e-3);
  EXPECT_NEAR(beside_long.rise_max / beside_short.rise_max, 1, 5e-3);
  EXPECT_GT(beside_long.rise_min, 1.2 * kMm);
}

TEST(SolvedScene, MayBeAMillionTimesAsLargeOrSmall) {
  const double exact = kWater * meniscus::exact_rise(glm::radians(60.0), kWater / (2 * kMm));
  for (const double scale : {1e-6, 1e6}) {
    meniscus::Liquid liquid = still_water(scaled(around(2 * kMm), scale));
    liquid.capillary_length = scale * kWater;
    const meniscus::Surface surface =
        solve(liquid, {solid(scaled(post(2 * kMm, -10 * kWater, 10 * kWater, 256), scale), 30)});
    EXPECT_NEAR(surface.contacts.at(0).rise_min / (scale * exact), 1, kPrecise) << scale;
    EXPECT_NEAR(surface.contacts.at(0).rise_max / (scale * exact), 1, kPrecise) << scale;
  }
}

TEST(SolvedScene, MayLieTenKilometresAway) {
  const dvec3 away(1e4, 1e4, -1e4);
  const meniscus::Surface here = solve_post(2 * kMm, 30),
                          there = solve(still_water(translated(around(2 * kMm), away)),
                                        {solid(translated(post(2 * kMm, -10 * kWater, 10 * kWater, 256), away), 30)});
  EXPECT_NEAR(there.contacts.at(0).rise_max / here.contacts.at(0).rise_max, 1, 1e-4);
  EXPECT_NEAR(there.contacts.at(0).rise_min / here.contacts.at(0).rise_min, 1, 1e-4);
}

TEST(SolvedContactLine, StaysOnASolidThatEndsBeforeTheMeniscus) {
  const double end = 1 * kMm;
  const meniscus::Surface above =
      solve(still_water(around(2 * kMm), kCoarse), {solid(post(2 * kMm, -20 * kMm, end, 256), 30)});
  const meniscus::Surface below =
      solve(still_water(around(2 * kMm), kCoarse), {solid(post(2 * kMm, -end, 20 * kMm, 256), 150)});
  expect_rise(above.contacts.at(0), end, 1e-6), expect_rise(below.contacts.at(0), -end, 1e-6);
  EXPECT_TRUE(warns(above, "pinned along 100 %"));
  EXPECT_TRUE(warns(below, "pinned along 100 %"));
}

// Planes that leave the liquid 3 degrees, below and above it.
TEST(SolvedRise, AtAPlaneAlmostLevelIsThatOfAFlatWall) {
  const auto check = [](double low, double high, double theta, double phi0) {
    const TriangleMesh plane = turned(box({-1, low, -1}, {1, high, 1}), 3, {0, 0, 1});
    const meniscus::Surface surface = solve(still_water(sheet(100 * kMm, 40)), {solid(plane, theta)});
    expect_rise(surface.contacts.at(0), 2 * kWater * std::sin(glm::radians(phi0) / 2), kPrecise);
  };
  check(-0.5, 0, 30, 3 - 30), check(-0.5, 0, 90, 3 - 90), check(0, 0.5, 80, 177 - 80);
}

TEST(SolvedRise, UnderASphereThatDipsAMillimetreRunsFarOut) {
  const double radius = 0.2, centre = 0.199;
  const meniscus::Surface surface = solve(still_water(sheet(80 * kMm, 40), kCoarse),
                                          {solid(translated(sphere(radius, 512, 256), {0, centre, 0}), 80)});
  expect_rise(surface.contacts.at(0), rise_at(ball(radius, centre), 80, 0, 6 * kMm), kGrazing);
}

TEST(SolvedSurface, OverhangsAtAWallThatDoes) {
  const TriangleMesh wall =
      turned(box({-60 * kWater, -40 * kWater, -6 * kWater}, {0, 40 * kWater, 6 * kWater}), -60, {0, 0, 1});
  const meniscus::Surface surface = solve(
      still_water(translated(rectangle(12 * kWater, 5 * kWater, 24), {8 * kWater, 0, 0}), kCoarse), {solid(wall, 10)});
  expect_rise(surface.contacts.at(0), 2 * kWater * std::sin(glm::radians(70.0)), kGrazing);
  int facing_down = 0;
  for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
    const glm::uvec3& v = surface.mesh.triangles[t];
    const auto& p = surface.mesh.positions;
    facing_down += surface.meniscus[t] && glm::cross(p[v.y] - p[v.x], p[v.z] - p[v.x]).y < 0;
  }
  EXPECT_GT(facing_down, 10);
  EXPECT_TRUE(surface.warnings.empty());
}

// A square dish 20 mm wide: in its corners no plane meets both walls at less than 45 degrees (Concus, Finn 1969).
meniscus::Surface solve_dish(double theta, double tolerance, double rim = 20 * kMm) {
  return solve(still_water(sheet(11 * kMm, 20), tolerance), {solid(tray(10 * kMm, 3 * kMm, -20 * kMm, rim), theta)});
}
constexpr const char* kUnbounded = "without bound";

TEST(SolvedCorner, TooNarrowForItsAngleHasABoundedRiseAndIsReported) {
  const meniscus::Surface surface = solve_dish(30, 4);
  const meniscus::Contact& contact = surface.contacts.at(0);
  EXPECT_TRUE(warns(surface, kUnbounded));
  EXPECT_GT(contact.rise_max, 1.8 * contact.rise_min);
  EXPECT_LT(contact.rise_max, 3 * kWater);
  EXPECT_NEAR(contact.rise_min / kWater, 1.03, 0.02);  // beside a wall alone 1; the others lift it
  EXPECT_NEAR(solve_dish(30, 1).contacts.at(0).rise_max / contact.rise_max, 1, 0.05);
  const meniscus::Contact mirrored = solve_dish(150, 4).contacts.at(0);
  EXPECT_NEAR(mirrored.rise_min / -contact.rise_max, 1, 1e-6);
}

TEST(SolvedCorner, RisesNoHigherThanItsWalls) {
  const double rim = 4 * kMm;
  const meniscus::Surface surface = solve_dish(30, 4, rim);
  EXPECT_NEAR(surface.contacts.at(0).rise_max / rim, 1, 1e-6);
  EXPECT_TRUE(warns(surface, kUnbounded));
  EXPECT_TRUE(warns(surface, "pinned"));
}

TEST(SolvedCorner, WideEnoughForItsAngleIsNotReported) {
  const meniscus::Surface surface = solve_dish(50, 4);
  EXPECT_FALSE(warns(surface, kUnbounded));
  EXPECT_GT(surface.contacts.at(0).rise_max, 1.5 * surface.contacts.at(0).rise_min);
  const double half = 2 * kMm;  // nor the edges of a post, at which every rise is finite
  EXPECT_FALSE(warns(solve(still_water(sheet(40 * kMm, 40), kCoarse),
                           {solid(box({-half, -20 * kMm, -half}, {half, 20 * kMm, half}), 30)}),
                     kUnbounded));
}

// A smooth ring lying at the surface.
TriangleMesh ring(double major, double minor, int facets, int around) {
  TriangleMesh mesh;
  const auto at = [&](int i, int j) { return static_cast<unsigned>((i % facets) * around + j % around); };
  for (int i = 0; i < facets; ++i) {
    for (int j = 0; j < around; ++j) {
      const double a = 2 * glm::pi<double>() * i / facets, b = 2 * glm::pi<double>() * (j + 0.25) / around;
      const dvec3 out(std::sin(a), 0, std::cos(a)), normal = std::cos(b) * out + dvec3(0, std::sin(b), 0);
      mesh.positions.push_back(major * out + minor * normal), mesh.normals.push_back(normal);
      mesh.triangles.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      mesh.triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  return mesh;
}

TEST(SolvedRise, RoundALyingRingIsExact) {
  const double major = 5 * kMm, minor = 1 * kMm, centre = 0.1 * kMm;
  const Outline across = ball(minor, centre);
  const Outline outside{[=](double h) { return major + across.radius(h); }, across.beta};
  const meniscus::Surface surface =
      solve(still_water(sheet(40 * kMm, 40)), {solid(translated(ring(major, minor, 128, 64), {0, centre, 0}), 60)});
  ASSERT_EQ(surface.contacts.size(), 2u);
  const meniscus::Contact& outer = surface.contacts[surface.contacts[0].length > surface.contacts[1].length ? 0 : 1];
  expect_rise(outer, rise_at(outside, 60, 0, 0.9 * kMm), kGrazing);
}

// Long way from the level to rest; the mirror image of the contact angle mirrors the line as well.
TEST(SolvedContactLine, OnAPostTiltedBy70DegreesIsMirrored) {
  const TriangleMesh straight = revolve([](double) { return 2 * kMm; }, -20 * kMm, 20 * kMm, 256, 64);
  const auto contact = [&](double theta) {
    return solve(still_water(sheet(40 * kMm, 40), kCoarse), {solid(turned(straight, 70, {0, 0, 1}), theta)})
        .contacts.at(0);
  };
  const meniscus::Contact wetted = contact(60), dry = contact(120);
  EXPECT_NEAR(wetted.rise_max / -dry.rise_min, 1, 1e-3);
  EXPECT_NEAR(wetted.rise_min / -dry.rise_max, 1, 1e-3);
  EXPECT_GT(wetted.rise_max, 2.1 * kMm);
  EXPECT_LT(wetted.rise_min, -0.5 * kMm);
}

TEST(SolvedContactLine, IsFoundOnLyingWiresNeedlesAndACubeOnItsCorner) {
  const TriangleMesh wire = revolve([](double) { return 0.3 * kMm; }, -8 * kMm, 8 * kMm, 64, 64);
  const TriangleMesh needle =
      revolve([](double y) { return 0.3 * kMm * (1 - std::abs(y) / (8 * kMm)) + 1e-6; }, -8 * kMm, 8 * kMm, 64, 64);
  for (const TriangleMesh& mesh : {wire, needle}) {
    const meniscus::Contact contact =
        solve(still_water(sheet(40 * kMm, 40), kCoarse), {solid(turned(mesh, 90, {0, 0, 1}), 30)}).contacts.at(0);
    EXPECT_GT(contact.rise_max, 0.2 * kMm);  // nearly as high as the wire
    EXPECT_LT(contact.rise_max, 0.3 * kMm);
  }
  const TriangleMesh cube = turned(turned(box(dvec3(-3 * kMm), dvec3(3 * kMm)), 45, {1, 0, 0}), 35.26439, {0, 0, 1});
  const meniscus::Surface surface =
      solve(still_water(sheet(40 * kMm, 40)), {solid(translated(cube, {0, 2.5 * kMm, 0}), 60)});
  EXPECT_TRUE(warns(surface, "pinned"));  // where its edges end, three corners up
  EXPECT_NEAR(surface.contacts.at(0).rise_min / kMm, 2.5 - 3 / std::sqrt(3.0), 1e-3);
}

// Where no step reaches the angle, the surface is at rest for one near by, which is told.
TEST(SolvedAngle, ThatIsNotReachedIsComeNearTo) {
  const double half = 2 * kMm;
  const meniscus::Surface surface =
      build(still_water(sheet(40 * kMm, 40), 4), {solid(box({-half, -20 * kMm, -half}, {half, 20 * kMm, half}), 0)});
  ASSERT_EQ(surface.contacts.size(), 1u);
  EXPECT_TRUE(surface.contacts[0].at_rest);
  EXPECT_EQ(surface.solution.failed > 0, warns(surface, "degrees off"));
  EXPECT_NEAR(surface.contacts[0].rise_min / kMm, 2.1, 0.2);
}

}  // namespace

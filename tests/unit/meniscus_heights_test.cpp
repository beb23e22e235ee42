// Heights of whole menisci: every rule and profile by its closed form, and where a solid's edge ends the rise.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "meniscus/check.h"
#include "meniscus/profile.h"
#include "meniscus/young_laplace.h"
#include "tests/support/csv.h"
#include "tests/unit/meniscus_shapes.h"

using namespace shapes;
using glm::dvec3;
using meniscal::test::number;
using meniscus::HeightRule;
using meniscus::Liquid;
using meniscus::Profile;
using meniscus::Surface;

namespace {

constexpr Profile kProfiles[] = {Profile::sine, Profile::exponential, Profile::circular, Profile::bessel};
constexpr HeightRule kRules[] = {HeightRule::wetting, HeightRule::equation2, HeightRule::exact};
constexpr double kRadius = 2 * kMm;

// So coarse round a post of 64 facets that all columns stand at its edges, where the polygon is the circle.
constexpr int kPostFacets = 64;
constexpr double kCoarse = 16;

Liquid liquid_with(HeightRule rule, Profile profile = Profile::sine) {
  Liquid liquid = water(sheet(30 * kMm, 1));
  liquid.height_rule = rule, liquid.profile = profile;
  return liquid;
}

double closed_form(HeightRule rule, double theta, double slope, double curvature) {
  switch (rule) {
    case HeightRule::wetting:
      return 2 * kWater * slope / 180;
    case HeightRule::equation2:
      return 2 * kWater * (1 - theta / 180);
    case HeightRule::exact:
      break;
  }
  return kWater * meniscus::exact_rise(glm::radians(slope), curvature * kWater);
}

void expect_height(const Surface& surface, double height) {
  EXPECT_TRUE(surface.warnings.empty()) << surface.warnings.front();
  ASSERT_EQ(surface.contacts.size(), 1u);
  EXPECT_NEAR(surface.contacts[0].rise_min, height, 1e-6 * std::abs(height));
  EXPECT_NEAR(surface.contacts[0].rise_max, height, 1e-6 * std::abs(height));
}

TEST(Heights, OfAPostFollowEveryRuleAndProfile) {
  const TriangleMesh mesh = post(kRadius, -50 * kMm, 10 * kMm, kPostFacets);
  for (const HeightRule rule : kRules) {
    for (const Profile profile : kProfiles) {
      for (const double theta : {30.0, 120.0}) {
        SCOPED_TRACE(testing::Message() << int(rule) << " " << int(profile) << " " << theta);
        Liquid liquid = liquid_with(rule, profile);
        liquid.height_scale = 0.7, liquid.sweep_scale = 1.3, liquid.tolerance = kCoarse;
        const Surface surface = build(liquid, {solid(mesh, theta)});
        const double height = 0.7 * closed_form(rule, theta, 90 - theta, 1 / kRadius), sweep = 2.6 * kWater;
        expect_height(surface, height);
        const meniscus::Report report = meniscus::inspect(surface.mesh);
        EXPECT_EQ(report.rejected, 0u);
        EXPECT_EQ(report.boundary_loops, 2u);
        EXPECT_GT(report.smallest_angle, 2);
        for (std::size_t i = 0; i < surface.mesh.positions.size(); ++i) {
          const dvec3 p = surface.mesh.positions[i];
          const double r = std::hypot(p.x, p.z), d = std::max(r - kRadius, 0.0) / sweep;
          const meniscus::Falloff fall = falloff(profile, d);
          const double slope = height / sweep * fall.slope;
          const dvec3 normal = r > 0 ? glm::normalize(dvec3(-slope * p.x / r, 1, -slope * p.z / r)) : dvec3(0, 1, 0);
          const bool at_wall = d < 1e-6;  // where the circular profile is vertical
          EXPECT_NEAR(p.y, at_wall ? height : height * fall.height, (at_wall ? 1e-6 : 1e-9) * std::abs(height)) << d;
          EXPECT_LT(glm::distance(surface.mesh.normals[i], normal), at_wall ? 2e-3 : 1e-6) << d;
        }
      }
    }
  }
}

TEST(Heights, ExactOnesGoByTheRadius) {
  for (const double radius : {0.035 * kMm, 0.5 * kMm, 8 * kMm}) {
    Liquid coarse = liquid_with(HeightRule::exact);
    coarse.tolerance = kCoarse;
    const Surface surface = build(coarse, {solid(post(radius, -50 * kMm, 10 * kMm, kPostFacets), 0)});
    expect_height(surface, kWater * meniscus::exact_rise(glm::half_pi<double>(), kWater / radius));
    if (radius < 0.1 * kMm) {
      EXPECT_NEAR(surface.contacts[0].rise_max, 0.18076 * kMm, 1e-5 * kMm);
    }
  }
  // Within a dish the liquid stands higher than at a flat wall.
  Liquid liquid = water(sheet(8.3 * kMm, 16));
  liquid.height_rule = HeightRule::exact;
  const Surface surface = build(liquid, {solid(cup(8 * kMm, 12 * kMm, -10 * kMm, 8 * kMm), 60, "dish")});
  ASSERT_EQ(surface.contacts.size(), 1u);
  const double expected = kWater * meniscus::exact_rise(glm::radians(30.0), -kWater / (8 * kMm));
  EXPECT_GT(expected, 1.05 * kWater * 2 * std::sin(glm::radians(15.0)));
  EXPECT_NEAR(surface.contacts[0].rise_min, expected, 1e-3 * expected);  // 96 facets
  EXPECT_NEAR(surface.contacts[0].rise_max, expected, 1e-3 * expected);
}

// The liquid's dihedral angle at the plane faces of a beach, a wall and an overhang.
TEST(Heights, OfTiltedWallsFollowTheDihedralAngle) {
  for (const HeightRule rule : kRules) {
    for (const double tilt : {-20.0, 0.0, 30.0}) {
      SCOPED_TRACE(testing::Message() << int(rule) << " " << tilt);
      const TriangleMesh wall =
          turned(box({-60 * kMm, -80 * kMm, -60 * kMm}, {0, 80 * kMm, 60 * kMm}), tilt, {0, 0, 1});
      const Surface surface = build(liquid_with(rule), {solid(wall, 40)});
      EXPECT_TRUE(surface.warnings.empty()) << surface.warnings.front();
      const double beta = 90 - tilt, height = closed_form(rule, 40, beta - 40, 0);
      ASSERT_EQ(surface.contacts.size(), 1u);
      EXPECT_NEAR(surface.contacts[0].rise_min, height, 1e-6 * std::abs(height));
      EXPECT_NEAR(surface.contacts[0].rise_max, height, 1e-6 * std::abs(height));
    }
  }
}

// Solid and liquid each have their own angle; a solid keeps its own beside others.
TEST(Heights, EverySolidHasItsContactAngle) {
  const TriangleMesh mesh = post(kRadius, -50 * kMm, 10 * kMm, 128);
  const Surface surface = build(
      liquid_with(HeightRule::exact),
      {solid(translated(mesh, {-13 * kMm, 0, 0}), 20, "wets"), solid(translated(mesh, {13 * kMm, 0, 0}), 140, "not")});
  ASSERT_EQ(surface.contacts.size(), 2u);
  for (const meniscus::Contact& contact : surface.contacts) {
    const double theta = contact.solid == "wets" ? 20 : 140;
    const double height = closed_form(HeightRule::exact, theta, 90 - theta, 1 / kRadius);
    EXPECT_NEAR(contact.rise_max, height, 1e-6 * std::abs(height));
    EXPECT_NEAR(contact.contact_angle, glm::radians(theta), 1e-15);
  }
}

// Pointwise the radius of curvature gives errors from -34 to +8 % here; its mean over a capillary length, a third.
TEST(Heights, OfAnEllipticPostAreNearItsEquilibrium) {
  constexpr int kFacets = 512;
  constexpr double a = 4 * kMm, b = 1.5 * kMm;
  TriangleMesh mesh;
  for (const double y : {-50 * kMm, 20 * kMm}) {
    for (int i = 0; i < kFacets; ++i) {
      const double w = 2 * glm::pi<double>() * i / kFacets;
      mesh.positions.push_back({a * std::sin(w), y, b * std::cos(w)});
      mesh.normals.push_back(glm::normalize(dvec3(std::sin(w) / a, 0, std::cos(w) / b)));
    }
  }
  for (unsigned i = 0; i < kFacets; ++i) {
    const unsigned k = (i + 1) % kFacets;
    mesh.triangles.emplace_back(i, k, kFacets + k);
    mesh.triangles.emplace_back(i, kFacets + k, kFacets + i);
  }
  const Surface surface = build(liquid_with(HeightRule::exact), {solid(mesh, 30)});
  const auto rows = meniscal::test::read_csv(std::string(TEST_DATA) + "/evolver_ellipse_contact.csv");
  ASSERT_GT(rows.size(), 100u);
  double squares = 0, worst = 0;
  for (const meniscal::test::Row& row : rows) {
    const dvec3 at(number(row, "x_mm") * kMm, 0, number(row, "y_mm") * kMm);
    double nearest = 1e300, height = 0;
    for (const dvec3& p : surface.mesh.positions) {
      const double distance = std::hypot(p.x - at.x, p.z - at.z);
      if (distance < nearest) nearest = distance, height = p.y;
    }
    const double error = height / (number(row, "h_mm") * kMm) - 1;
    squares += error * error, worst = std::max(worst, std::abs(error));
  }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(rows.size())), 0.07);
  EXPECT_LT(worst, 0.12);
}

// Above the solid's top or below its bottom there is nothing to hold the liquid: its line stays at the edge.
TEST(Heights, PinAtTheSolidsEdges) {
  const double edge = 0.4 * kMm;
  for (const double theta : {20.0, 160.0}) {
    for (const bool round : {false, true}) {
      SCOPED_TRACE(testing::Message() << theta << (round ? " post" : " box"));
      const double low = theta < 90 ? -20 * kMm : -edge, high = theta < 90 ? edge : 20 * kMm;
      const TriangleMesh mesh =
          round ? post(kRadius, low, high, 128) : box({-5 * kMm, low, -4 * kMm}, {5 * kMm, high, 4 * kMm});
      for (const HeightRule rule : {HeightRule::wetting, HeightRule::exact}) {
        const Surface surface = build(liquid_with(rule), {solid(mesh, theta, "stub")});
        ASSERT_EQ(surface.contacts.size(), 1u);
        const double expected = theta < 90 ? edge : -edge;
        EXPECT_NEAR(surface.contacts[0].rise_min, expected, 1e-6 * edge);
        EXPECT_NEAR(surface.contacts[0].rise_max, expected, 1e-6 * edge);
        ASSERT_EQ(surface.warnings.size(), 1u);
        EXPECT_NE(surface.warnings[0].find("'stub': the contact line is pinned along 100 %"), std::string::npos)
            << surface.warnings[0];
      }
    }
  }
}

TEST(Heights, FlattenedMenisciStayLevelAndKeepTheirNormals) {
  const TriangleMesh mesh = turned(post(kRadius, -50 * kMm, 40 * kMm, 128), 30, {0, 0, -1});
  Liquid liquid = liquid_with(HeightRule::wetting);
  const Surface raised = build(liquid, {solid(mesh, 30)});
  liquid.flatten = true;
  const Surface flat = build(liquid, {solid(mesh, 30)});
  ASSERT_EQ(flat.mesh.positions.size(), raised.mesh.positions.size());
  ASSERT_EQ(flat.mesh.triangles, raised.mesh.triangles);
  EXPECT_EQ(flat.meniscus, raised.meniscus);
  double steepest = 1, highest = 0;
  for (std::size_t i = 0; i < flat.mesh.positions.size(); ++i) {
    EXPECT_NEAR(flat.mesh.positions[i].y, 0, 1e-16);
    EXPECT_EQ(flat.mesh.normals[i], raised.mesh.normals[i]);
    steepest = std::min(steepest, flat.mesh.normals[i].y), highest = std::max(highest, raised.mesh.positions[i].y);
  }
  EXPECT_LT(steepest, 0.9);
  EXPECT_GT(highest, 0.5 * kMm);
  EXPECT_EQ(meniscus::inspect(flat.mesh).boundary_loops, 2u);
}

TEST(Heights, FlattenedMenisciNeedNoRoomToRise) {
  // Two slanted walls that lean over the gap between them: raised, their menisci would fold into each other.
  const TriangleMesh wall = box({-20 * kMm, -30 * kMm, -3 * kMm}, {20 * kMm, 30 * kMm, 3 * kMm});
  const auto leaning = [&](double side) {
    return translated(turned(wall, side * 50, {1, 0, 0}), {0, 0, side * 5.3 * kMm});
  };
  Liquid liquid = water(sheet(80 * kMm, 1));
  const std::vector<meniscus::Solid> walls{solid(leaning(1), 10, "left"), solid(leaning(-1), 10, "right")};
  const auto is_lowered = [](const Surface& surface) {
    return std::any_of(surface.warnings.begin(), surface.warnings.end(),
                       [](const std::string& w) { return w.find("is lowered") != std::string::npos; });
  };
  EXPECT_TRUE(is_lowered(build(liquid, walls)));
  liquid.flatten = true;
  const Surface flat = build(liquid, walls);
  EXPECT_FALSE(is_lowered(flat));
  for (const dvec3& p : flat.mesh.positions) EXPECT_NEAR(p.y, 0, 1e-16);
}

// Chords between layers leave every smooth profile as little as they leave the sine.
TEST(Heights, LayersFollowTheProfilesBend) {
  const auto error = [](Profile profile) {
    const Surface surface = build(liquid_with(HeightRule::wetting, profile),
                                  {solid(box({-20 * kMm, -10 * kMm, -8 * kMm}, {20 * kMm, 10 * kMm, 8 * kMm}), 30)});
    const auto& p = surface.mesh.positions;
    double worst = 0;
    for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
      const glm::uvec3& v = surface.mesh.triangles[t];
      const dvec3 centre = (p[v.x] + p[v.y] + p[v.z]) / 3.0;
      if (!surface.meniscus[t] || std::abs(centre.x) > 15 * kMm || std::abs(centre.z) < 8 * kMm) continue;
      const double d = (std::abs(centre.z) - 8 * kMm) / (2 * kWater);
      worst = std::max(worst, std::abs(centre.y - surface.contacts[0].rise_max * falloff(profile, d).height));
    }
    return worst / surface.contacts[0].rise_max;
  };
  const double sine = error(Profile::sine);
  EXPECT_LT(sine, 1e-4);
  EXPECT_LT(error(Profile::exponential), 1.1 * sine);
  EXPECT_LT(error(Profile::bessel), 1.1 * sine);
  EXPECT_LT(error(Profile::circular), 0.02);  // at the wall, where it is vertical
}

}  // namespace

// What callers may rely on: what stays untouched, invariances, what is refused, what is told of each contact.
#include <gtest/gtest.h>

#include <set>

#include "tests/support/meniscus/surface.h"

using namespace shapes;
using namespace surfaces;
using glm::dvec3;
using meniscus::Surface;

namespace {

TEST(Build, LiquidFarFromTheSolidIsUntouched) {
  const auto waves = [](double x, double z) { return 0.3 * kMm * std::sin(x / (3 * kMm)) * std::cos(z / (4 * kMm)); };
  const TriangleMesh mesh = sheet(20 * kMm, 80, waves);
  const Surface surface = build(water(mesh), {solid(tall_post(), 30)});
  EXPECT_EQ(expect_sound(surface).boundary_loops, 2u);
  const auto corner_set = [](const TriangleMesh& m) {
    std::set<std::vector<double>> result;
    for (const glm::uvec3& t : m.triangles) {
      std::vector<double> key;
      for (int i = 0; i < 3; ++i) {
        for (const dvec3& v : {m.positions[t[i]], m.normals[t[i]]}) key.insert(key.end(), {v.x, v.y, v.z});
      }
      result.insert(key);
    }
    return result;
  };
  const auto kept = corner_set(surface.mesh);
  std::size_t checked = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    const dvec3 p = mesh.positions[t.x];
    if (std::hypot(p.x, p.z) < 2 * kMm + 1.05 * kSweep + 2 * kMm) continue;
    ++checked;
    EXPECT_TRUE(kept.contains(*corner_set({mesh.positions, mesh.normals, {t}}).begin()));
  }
  EXPECT_GT(checked, 5000u);
}

TEST(Build, TopologyDoesNotDependOnScaleOrPlace) {
  for (const double s : {1e-3, 1.0, 1e3}) {
    meniscus::Liquid liquid = water(scaled(sheet(30 * kMm, 1), s));
    liquid.capillary_length *= s;
    const Surface surface = build(liquid, {solid(scaled(tall_post(), s), 30)});
    EXPECT_EQ(expect_sound(surface, 10).boundary_loops, 2u);
    EXPECT_NEAR(static_cast<double>(surface.mesh.triangles.size()), 21304, 300);
    EXPECT_NEAR(surface.contacts[0].rise_max, s * kSweep * 60 / 180, 1e-12 * s);
  }
  const dvec3 far(10, 3, -7);
  const Surface surface = build(water(translated(sheet(30 * kMm, 1), far)), {solid(translated(tall_post(), far), 30)});
  EXPECT_EQ(expect_sound(surface, 10).boundary_loops, 2u);
}

TEST(Build, IsDeterministicAndBlindToTheSolidsWinding) {
  const Surface a = build(water(sheet(30 * kMm, 4)), {solid(tall_post(), 30)});
  const Surface b = build(water(sheet(30 * kMm, 4)), {solid(tall_post(), 30)});
  const Surface c = build(water(sheet(30 * kMm, 4)), {solid(inside_out(tall_post()), 30)});
  EXPECT_EQ(a.mesh.positions, b.mesh.positions);
  EXPECT_EQ(a.mesh.normals, b.mesh.normals);
  EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
  EXPECT_EQ(a.mesh.positions.size(), c.mesh.positions.size());
  EXPECT_NEAR(c.contacts.at(0).rise_max, kSweep * 60 / 180, 1e-12);
}

TEST(Build, UnusableInputIsRefusedByName) {
  const auto message = [](const meniscus::Liquid& liquid, const std::vector<meniscus::Solid>& solids) {
    try {
      build(liquid, solids);
    } catch (const std::invalid_argument& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  TriangleMesh broken = tall_post(16);
  broken.triangles.emplace_back(0, 1, 100000);
  EXPECT_NE(message(water(sheet(1, 1)), {solid(broken, 30, "rod")}).find("'rod'"), std::string::npos);
  broken = tall_post(16);
  broken.positions[3].y = std::nan("");
  EXPECT_NE(message(water(sheet(1, 1)), {solid(broken, 30, "rod")}).find("'rod'"), std::string::npos);
  EXPECT_NE(message(water(sheet(1, 1)), {solid(tall_post(16), 200, "rod")}).find("'rod'"), std::string::npos);
  EXPECT_NE(message(water({}), {}).find("'water'"), std::string::npos);
  meniscus::Liquid liquid = water(sheet(1, 1));
  liquid.capillary_length = 0;
  EXPECT_NE(message(liquid, {}).find("'water'"), std::string::npos);
  liquid = water(sheet(30 * kMm, 1));
  liquid.sweep_scale = 1e-9;
  const std::string endless = message(liquid, {solid(tall_post(16), 30, "rod")});
  EXPECT_NE(endless.find("solid 'rod': its contour of 0.01248"), std::string::npos) << endless;
}

TEST(Build, ContactsKnowTheirTrianglesAndWhatConcernsThem) {
  // The stub ends 0.5 mm above the level, below the height that its meniscus would reach.
  const TriangleMesh tall = translated(post(2 * kMm, -10 * kMm, 10 * kMm, 64), {-15 * kMm, 0, 0});
  const TriangleMesh low = translated(post(1 * kMm, -10 * kMm, 0.5 * kMm, 64), {15 * kMm, 0, 0});
  const Surface surface = meniscus::build(water(sheet(40 * kMm, 4)), {solid(tall, 30, "tall"), solid(low, 30, "stub")});
  ASSERT_EQ(surface.contacts.size(), 2u);
  std::size_t by_side[2] = {0, 0};
  for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t)
    if (surface.meniscus[t]) ++by_side[surface.mesh.positions[surface.mesh.triangles[t].x].x > 0];
  for (const meniscus::Contact& contact : surface.contacts) {
    const bool stub = contact.solid == "stub";
    EXPECT_EQ(contact.triangles, by_side[stub]);
    EXPECT_EQ(contact.warnings.size(), stub ? 1u : 0u);
  }
}

// Names within names, quotes and equal names do not lead a warning to another solid's contact.
TEST(Build, WarningsGoByTheSolidNotByItsName) {
  const auto at = [](double x, double top) {
    return translated(post(1 * kMm, -10 * kMm, top * kMm, 64), {x * kMm, 0, 0});
  };
  const Surface surface =
      build(water(sheet(40 * kMm, 4)), {solid(at(-20, 10), 30, "post"), solid(at(0, 0.5), 30, "a solid 'post'"),
                                        solid(at(20, 10), 30, "a solid 'post'")});
  ASSERT_EQ(surface.contacts.size(), 3u);
  ASSERT_EQ(surface.warnings.size(), 1u);
  EXPECT_TRUE(surface.contacts[0].warnings.empty());
  EXPECT_EQ(surface.contacts[1].warnings, surface.warnings);
  EXPECT_TRUE(surface.contacts[2].warnings.empty());
}

}  // namespace

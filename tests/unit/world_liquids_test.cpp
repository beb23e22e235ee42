// What a scene says of its liquids' menisci reaches the surface that is rendered.
#include <gtest/gtest.h>

#include <algorithm>

#include "host/world/world.h"
#include "meniscus/young_laplace.h"
#include "tests/unit/meniscus_shapes.h"

using namespace shapes;

namespace meniscal {
namespace {

constexpr double kRadius = 2 * kMm;

// A post in a dish of water; `edit` changes the water.
World with_water(const std::function<void(LiquidProperties&)>& edit) {
  Scene scene = load_gltf(std::string(SCENES) + "/shadow_sausage.gltf");
  const auto water =
      std::find_if(scene.materials.begin(), scene.materials.end(), [](const Material& m) { return m.liquid; });
  const auto liquid = static_cast<int>(water - scene.materials.begin());
  edit(*water->liquid);
  Material black;
  black.contact_angle = 30;
  scene.materials.push_back(black);
  const int solid = static_cast<int>(scene.materials.size()) - 1;
  scene.objects = {
      {.name = "water", .mesh = sheet(30 * kMm, 1), .has_file_normals = true, .material = liquid},
      {.name = "post", .mesh = post(kRadius, -50 * kMm, 10 * kMm, 128), .closed = true, .material = solid}};
  return build_world(scene, MeniscusModel::paper);
}

double rise(const World& world) { return world.liquids.at(0).contacts.at(0).rise_max; }

// Mean height of the menisci's corners, and the highest.
double height(const World& world, bool highest) {
  double sum = 0, most = 0;
  std::size_t count = 0;
  for (const WorldTriangle& t : world.triangles) {
    if (!t.meniscus) continue;
    for (const glm::dvec3& p : t.corner) sum += p.y, ++count, most = std::max(most, p.y);
  }
  return highest ? most : sum / static_cast<double>(count);
}

TEST(WorldLiquids, HeightRules) {
  const double l = std::sqrt(0.0728 / (998.2 * 9.80665));
  const auto rise_by = [](const std::string& rule) {
    return rise(with_water([&](LiquidProperties& p) { p.height_rule = rule, p.height_scale = 0.5; }));
  };
  EXPECT_NEAR(rise_by("wetting"), l * 60 / 180, 1e-9 * l);
  EXPECT_NEAR(rise_by("equation2"), l * 150 / 180, 1e-9 * l);
  EXPECT_NEAR(rise_by("exact"), 0.5 * l * meniscus::exact_rise(glm::radians(60.0), l / kRadius), 1e-6 * l);
}

TEST(WorldLiquids, ProfilesDiffer) {
  std::vector<double> means;
  for (const std::string profile : {"sine", "exponential", "circular", "bessel"}) {
    const World world = with_water([&](LiquidProperties& p) { p.profile = profile; });
    EXPECT_NEAR(height(world, true), rise(world), 1e-12);
    means.push_back(height(world, false));
  }
  std::sort(means.begin(), means.end());
  for (std::size_t i = 1; i < means.size(); ++i) EXPECT_GT(means[i], 1.01 * means[i - 1]);
}

TEST(WorldLiquids, ToleranceCountsInMetres) {
  const auto triangles_at = [](std::optional<double> tolerance) {
    return with_water([&](LiquidProperties& p) { p.tolerance = tolerance; }).liquids.at(0).contacts.at(0).triangles;
  };
  const double usual = meniscus::kHeightTolerance * std::sqrt(0.0728 / (998.2 * 9.80665));
  EXPECT_EQ(triangles_at(usual), triangles_at({}));
  EXPECT_LT(triangles_at(4 * usual), 0.35 * double(triangles_at({})));
  EXPECT_GT(triangles_at(usual / 4), 3 * triangles_at({}));
}

TEST(WorldLiquids, FlattenLeavesItLevel) {
  const World world = with_water([](LiquidProperties& p) { p.flatten = true; });
  EXPECT_EQ(height(world, true), 0);
  double steepest = 1;
  for (const WorldTriangle& t : world.triangles) {
    if (t.meniscus) steepest = std::min(steepest, t.normal[0].y);
  }
  EXPECT_LT(steepest, 0.95);
}

// Where wires of a tilted clip come together, one's contact line lies behind the other's.
TEST(WorldLiquids, MenisciOfWiresWithoutRoomBetweenThem) {
  Scene scene = load_gltf(std::string(SCENES) + "/paper_clip.gltf");
  for (Object& o : scene.objects)
    if (o.name == "clip") o.mesh = translated(turned(o.mesh, 2, {1, 0, 0}), {0, 0.1 * kMm, 0});
  const World world = build_world(scene, MeniscusModel::paper);
  ASSERT_EQ(world.liquids.size(), 1u);
  EXPECT_GT(world.liquids[0].triangles, 5000u);
  EXPECT_EQ(world.liquids[0].contacts.size(), 1u);
}

}  // namespace
}  // namespace meniscal

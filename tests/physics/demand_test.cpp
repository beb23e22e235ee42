// Menisci are as fine as their view needs, and those that nobody sees cost little.
#include <cmath>

#include "host/image/compare.h"
#include "host/render/film.h"
#include "host/render/plan.h"
#include "tests/support/scene_objects.h"
#include "tests/support/skies.h"
#include "tests/support/textured_scene.h"

namespace meniscal {
namespace {

Scene post(double sun_degrees = 0) {
  Scene scene = load_gltf(std::string(SCENES) + "/post.gltf");
  if (sun_degrees > 0) test::widen_suns(scene, sun_degrees);
  return scene;
}
RenderOptions pixels(int side) { return test::small_options(20000, side, side); }

meniscus::Need need_of(const Scene& scene, const RenderOptions& options) {
  const World world = build_world(options, scene);
  EXPECT_EQ(world.liquids.at(0).contacts.size(), 1u);
  return world.liquids[0].contacts[0].need;
}
std::size_t triangles_of(const Scene& scene, const RenderOptions& options) {
  return build_world(options, scene).liquids.at(0).triangles;
}

// Opaque; light and camera are outside of it, or the camera inside.
void cover(Scene& scene, const glm::dvec3& low, const glm::dvec3& high) {
  Material board = test::make_matte("board");
  board.meniscus_ignore = true;
  scene.materials.push_back(board);
  scene.objects.push_back(
      test::make_box("cover", static_cast<int>(scene.materials.size()) - 1, low - scene.origin, high - scene.origin));
}

Image render(const test::Setup& setup, PassRange passes) {
  GpuBackend gpu(gpu::Device::open("auto"), setup.world, setup.settings);
  Film film(setup.settings.crop, {}, MapScale{});
  render_passes(gpu, passes, film, [](const Tallies&) { return true; });
  return film.image(setup.settings.width, setup.settings.height);
}
LayerDifference difference(const Image& image, const Image& truth) {
  return compare(image, "image", truth, "truth").front();
}

TEST(Demand, FollowsThePixelsOfTheCaustic) {
  double before = 100;
  for (const int side : {64, 256, 1024, 4096}) {
    Scene scene = post();
    const double coarseness = need_of(scene, pixels(side)).coarseness;
    EXPECT_LE(coarseness, before);
    before = coarseness;
  }
  EXPECT_LT(before, 0.5);
  EXPECT_GE(before, 0.25);
  EXPECT_GT(triangles_of(post(), pixels(4096)), 2 * triangles_of(post(), pixels(256)));
}

TEST(Demand, IsNoCoarserThanUsualWhereHighlightsOfNarrowLightsAreSeen) {
  EXPECT_EQ(need_of(post(), pixels(16)).coarseness, 1);
  EXPECT_GT(need_of(post(1), pixels(16)).coarseness, 2);
}

TEST(Demand, FallsWithTheViewsDistance) {
  const auto seen_from = [](double height) {
    Scene scene = post();
    Camera& camera = scene.cameras[0];
    test::look_down_on(scene, {0, height, 0}, 0);
    camera.orthographic = false;
    camera.yfov = glm::radians(30.0);
    return need_of(scene, pixels(4096)).coarseness;
  };
  EXPECT_LT(seen_from(0.1), seen_from(0.3));
}

TEST(Demand, OfWhatIsCoveredIsLeastAndPhotonsStartElsewhere) {
  Scene covered = post();
  cover(covered, {-0.2, -0.2, -0.2}, {0.2, 0.08, 0.2});
  const World world = build_world(pixels(64), covered);
  const meniscus::Need need = world.liquids.at(0).contacts.at(0).need;
  EXPECT_EQ(need.coarseness, 16);
  EXPECT_FALSE(need.target);
  EXPECT_EQ(test::find_stratum(world, "targeted"), nullptr);
  EXPECT_LT(world.liquids[0].triangles, triangles_of(post(), pixels(64)) / 4);
  EXPECT_GT(world.liquids[0].triangles, 0u);
  EXPECT_EQ(make_plan(world, 0, glm::uvec4(0)).front().why,
            "1 liquid-solid contacts, 1 of them without light or out of sight");
}

TEST(Demand, OfWhatTheCameraCannotSeeIsLeast) {
  Scene scene = post();
  const glm::dvec3 eye(0, 0.04, 0);
  test::look_down_on(scene, eye, 0.006);
  EXPECT_TRUE(need_of(scene, pixels(64)).target);
  cover(scene, eye - 0.01, eye + 0.01);
  EXPECT_FALSE(need_of(scene, pixels(64)).target);
}

// The bright edge that the meniscus throws, without the meniscus.
TEST(Demand, FollowsThePixelsOfACausticFarFromItsMeniscus) {
  Scene scene = post();
  for (Material& m : scene.materials) m.contact_angle = 120;
  test::look_down_on(scene, {5.8e-3, 0.04, 0}, 1e-3);
  const meniscus::Need need = need_of(scene, pixels(64));
  EXPECT_TRUE(need.target);
  EXPECT_LT(need.coarseness, 1);
}

TEST(Demand, OfWhatLightReachesByAWindowIsNotLeast) {
  Scene scene = post();
  const Object lid =
      test::make_quad("lid", glm::dvec3(-0.01, 0.05, -0.01) - scene.origin, {0.02, 0, 0}, {0, 0, 0.02}, 0);
  scene.objects.push_back(lid);
  test::look_down_on(scene, {0, 0.04, 0}, 0.006);
  EXPECT_TRUE(need_of(scene, pixels(64)).target);
}

// A second post in a covered dish, as large as the first.
TEST(Demand, LeavesThePictureUnchanged) {
  REQUIRE_DEVICE();
  Scene scene = post(0.5);
  const auto add = [&](const char* like, const char* name) {
    for (const Object& o : scene.objects)
      if (o.name == like) {
        Object copy = o;
        copy.name = name;
        for (glm::dvec3& p : copy.mesh.positions) p.x += 1;
        scene.objects.push_back(copy);
        return;
      }
    FAIL() << like;
  };
  add("water", "water below the cover");
  add("post", "post below the cover");
  cover(scene, {0.7, -0.3, -0.3}, {1.3, 0.3, 0.3});
  const RenderOptions options = pixels(64);
  const auto setup_of = [&](World world) {
    const RenderSettings settings = choose_settings(options, scene, world);
    return test::Setup{scene, std::move(world), settings};
  };
  const test::Setup needed = setup_of(build_world(options, scene)),
                    usual = setup_of(build_world(scene, options.meniscus));
  const auto triangles = [](const World& world) {
    std::size_t sum = 0;
    for (const LiquidReport& l : world.liquids) sum += l.triangles;
    return sum;
  };
  EXPECT_LT(triangles(needed.world), triangles(usual.world) * 6 / 10);
  EXPECT_NEAR(test::find_stratum(needed.world, "targeted")->area, test::find_stratum(usual.world, "targeted")->area / 2,
              1e-6);

  const Image truth = render(usual, {1000, 1064});
  const LayerDifference by_need = difference(render(needed, {0, 8}), truth),
                        as_usual = difference(render(usual, {0, 8}), truth);
  EXPECT_LT(by_need.relative_rmse, 1.02 * as_usual.relative_rmse);
  EXPECT_NEAR(by_need.mean_ratio, 1, 0.003);
}

}  // namespace
}  // namespace meniscal

// Dielectrics that lie in each other: slabs by Snell, Fresnel and Beer, and what cameras and lights are in.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <numeric>

#include "host/world/media.h"
#include "tests/support/scene_objects.h"
#include "tests/support/scene_setup.h"

namespace meniscal {
namespace {

constexpr double mm = 1e-3, water_ior = 1.333, glass_ior = 1.5, absorption = 20;

// A plate of glass (20 to 24 mm, if `lid`), water (11 to 21 mm) and a plate of glass (8 to 12 mm) over the floor at
// -50 mm: water reaches 1 mm into the plates.
std::unique_ptr<test::Setup> make_slabs(const RenderOptions& options, bool lid,
                                        const std::function<void(Scene&)>& edit = {}) {
  return test::make_setup("flat_water", options, [&](Scene& scene) {
    std::erase_if(scene.objects, [](const Object& o) { return o.name != "floor"; });
    for (glm::dvec3& p : scene.objects[0].mesh.positions) p = (p + scene.origin) * glm::dvec3(4, 1, 4);
    scene.origin = glm::dvec3(0);
    for (Material& m : scene.materials)
      if (m.liquid) m.absorption = glm::dvec3(absorption);
    const auto water = static_cast<int>(std::find_if(scene.materials.begin(), scene.materials.end(),
                                                     [](const Material& m) { return m.liquid.has_value(); }) -
                                        scene.materials.begin());
    Material glass = test::make_clear("glass", glass_ior);
    glass.meniscus_ignore = true;
    scene.materials.push_back(glass);
    const int last = static_cast<int>(scene.materials.size()) - 1;
    const double half = 20 * mm;
    scene.objects.push_back(test::make_box("water", water, {-half, 11 * mm, -half}, {half, 21 * mm, half}));
    scene.objects.push_back(test::make_box("plate", last, {-half, 8 * mm, -half}, {half, 12 * mm, half}));
    if (lid) scene.objects.push_back(test::make_box("lid", last, {-half, 20 * mm, -half}, {half, 24 * mm, half}));
    if (edit) edit(scene);
  });
}

// Looks down from `height` above the origin, `angle` from straight down towards +x.
void look_down(Scene& scene, double height, double angle) {
  Camera& camera = scene.cameras[0];
  camera.orthographic = false;
  camera.yfov = 0.01;
  const glm::dvec3 back(-std::sin(angle), std::cos(angle), 0), right(0, 0, 1), up = glm::cross(back, right);
  camera.pose = glm::dmat4(glm::dvec4(right, 0), glm::dvec4(up, 0), glm::dvec4(back, 0), glm::dvec4(0, height, 0, 1));
}

// Fresnel's formulas by angles.
double transmittance(double a, double b) {
  const double s = std::sin(a - b) / std::sin(a + b), p = std::tan(a - b) / std::tan(a + b);
  return 1 - (s * s + p * p) / 2;
}

struct Layer {
  double ior, depth, absorption;
};

// Where a ray ends that goes down through the layers, and what remains of its light.
std::pair<double, double> by_hand(const std::vector<Layer>& layers, double angle) {
  const double sine = layers.front().ior * std::sin(angle);
  double x = 0, part = 1, before = angle;
  for (const Layer& l : layers) {
    const double here = std::asin(sine / l.ior);
    x += l.depth * std::tan(here);
    part *= std::exp(-l.absorption * l.depth / std::cos(here));
    if (&l != &layers.front()) part *= transmittance(before, here);
    before = here;
  }
  return {x, part};
}

// The ray in the middle of the image, through all surfaces; as many specular ones as there are real ones.
void expect_ray(const test::Setup& setup, double x, double radiance) {
  for (const bool on_gpu : {true, false}) {
    SCOPED_TRACE(on_gpu ? "GPU" : "reference");
    const std::unique_ptr<Backend> backend = test::make_backend(on_gpu, setup.world, setup.settings);
    const shared::PixelSample s = backend->trace_camera(0, {0, shared::BRANCH_THROUGH_ALL})[4];
    ASSERT_LT(s.triangle, shared::END_FIRST);
    EXPECT_NEAR(s.position.x, x, 2e-7);
    EXPECT_NEAR(s.position.y, -50 * mm, 1e-7);
    EXPECT_NEAR(s.weight.x * glm::pi<float>() / s.albedo.x, radiance, 2e-5 * radiance);
    EXPECT_EQ(backend->statistics().media_dropped, 0u);
  }
}

TEST(Nested, SlabsBendAndReflectAsTheyLieInEachOther) {
  REQUIRE_DEVICE();
  for (const double angle : {0.2, 0.4, 0.5}) {
    SCOPED_TRACE(angle);
    RenderOptions options = test::small_options(1000, 3, 3);
    options.specular_bounces = 4;
    const auto setup = make_slabs(options, true, [&](Scene& scene) { look_down(scene, 40 * mm, angle); });
    const auto [x, part] = by_hand({{1, 16 * mm, 0},
                                    {glass_ior, 4 * mm, 0},
                                    {water_ior, 8 * mm, absorption},
                                    {glass_ior, 4 * mm, 0},
                                    {1, 58 * mm, 0}},
                                   angle);
    expect_ray(*setup, x, part);
  }
}

// It sees less through the water before it, and all brighter: radiance is as n^2.
TEST(Nested, CameraInWaterKnowsIt) {
  REQUIRE_DEVICE();
  RenderOptions options = test::small_options(1000, 3, 3);
  options.specular_bounces = 2;
  const double angle = 0.5;
  const auto setup = make_slabs(options, true, [&](Scene& scene) { look_down(scene, 16 * mm, angle); });
  const auto [x, part] = by_hand({{water_ior, 4 * mm, absorption}, {glass_ior, 4 * mm, 0}, {1, 58 * mm, 0}}, angle);
  expect_ray(*setup, x, part * water_ior * water_ior);
}

// Of vertical light on water in a dish of glass the parts that the three real surfaces let through arrive.
TEST(Nested, FluxThroughWaterAndGlass) {
  REQUIRE_DEVICE();
  RenderOptions options = test::small_options(400000, 16, 16);
  options.specular_bounces = 3;
  const auto setup = make_slabs(options, false, [](Scene& scene) {
    for (Material& m : scene.materials) m.absorption = glm::dvec3(0);
  });
  const auto passes = [](double n, double m) { return 1 - (n - m) * (n - m) / ((n + m) * (n + m)); };
  const double expected = passes(1, water_ior) * passes(water_ior, glass_ior) * passes(glass_ior, 1);
  for (const bool on_gpu : {true, false}) {
    const std::unique_ptr<Backend> backend = test::make_backend(on_gpu, setup->world, setup->settings);
    const Tally tally = test::render_pass(*backend, 0).tallies[shared::MAP_CAUSTIC];
    const double part = std::accumulate(tally.flux_landed.begin(), tally.flux_landed.end(), 0.0) / tally.flux_in;
    std::printf("%.5f of the light arrives, %.5f by hand\n", part, expected);
    EXPECT_NEAR(part, expected, 0.002);
  }
}

// A block that refracts as water does, in the water and above it. Askew, so that rays in the middle meet no edge.
std::unique_ptr<test::Setup> make_block(const RenderOptions& options, double centre, double half, double angle,
                                        const std::function<void(Scene&)>& edit = {}) {
  return test::make_setup("flat_water", options, [&](Scene& scene) {
    for (Object& o : scene.objects)
      for (glm::dvec3& p : o.mesh.positions) p += scene.origin;
    scene.origin = glm::dvec3(0);
    Material like_water = test::make_clear("like water", water_ior);
    like_water.contact_angle = angle;
    scene.materials.push_back(like_water);
    scene.objects.push_back(test::make_box("block", static_cast<int>(scene.materials.size()) - 1,
                                           {centre - half, -40 * mm, -0.7 * half}, {centre + half, 10 * mm, half}));
    if (edit) edit(scene);
  });
}

// Looked into from above, out through its side below the water: it bends at its top alone.
TEST(Nested, BlockLikeWaterIsInvisibleInIt) {
  REQUIRE_DEVICE();
  const double angle = 0.2;
  for (const double contact : {90.0, 30.0}) {
    SCOPED_TRACE(contact);
    RenderOptions options = test::small_options(1000, 3, 3);
    options.specular_bounces = 2;
    const auto setup = make_block(options, 30 * mm * std::tan(angle) + 0.2 * mm, 2 * mm, contact,
                                  [&](Scene& scene) { look_down(scene, 40 * mm, angle); });
    const auto [x, part] = by_hand({{1, 30 * mm, 0}, {water_ior, 60 * mm, 0}}, angle);
    expect_ray(*setup, x, part / (water_ior * water_ior));
  }
}

// Light that falls through a block like water into water below it has met one surface.
TEST(Nested, FluxThroughABlockLikeWater) {
  REQUIRE_DEVICE();
  RenderOptions options = test::small_options(400000, 16, 16);
  options.specular_bounces = 2;
  const auto setup = make_block(options, 0, 20 * mm, 90);
  GpuBackend gpu(gpu::Device::open("auto"), setup->world, setup->settings);
  const Tally tally = test::render_pass(gpu, 0).tallies[shared::MAP_CAUSTIC];
  const double part = std::accumulate(tally.flux_landed.begin(), tally.flux_landed.end(), 0.0) / tally.flux_in;
  EXPECT_NEAR(part, 0.979627, 0.002);
}

// A lamp in the water shines through its water alone, and into the glass as from water.
TEST(Nested, LampInWaterKnowsIt) {
  const auto setup = make_slabs(test::small_options(1000, 3, 3), true, [](Scene& scene) {
    scene.lights[0].type = PunctualLight::Type::point;
    scene.lights[0].position = {1 * mm, 15 * mm, 2 * mm};
  });
  const std::uint32_t water = setup->world.lights[0].media.x & shared::MEDIUM_SURFACE_MASK;
  ASSERT_GT(water, 0u);
  EXPECT_NEAR(setup->world.surfaces[water - 1].ior, water_ior, 1e-6);
  EXPECT_EQ(setup->world.lights[0].media.y, 0u);
}

TEST(Nested, PointsKnowWhatTheyAreIn) {
  const auto setup = test::make_setup("beaker", test::small_options(1000, 3, 3));
  const World& world = setup->world;
  const auto iors = [&](const glm::dvec3& point) {
    std::vector<float> result;
    const glm::uvec4 media = media_at(world, point - setup->scene.origin);
    for (int i = 0; i < 4 && media[i] != 0; ++i)
      result.push_back(world.surfaces[(media[i] & shared::MEDIUM_SURFACE_MASK) - 1].ior);
    return result;
  };
  using Iors = std::vector<float>;
  EXPECT_EQ(iors({0, 60 * mm, 0}), Iors{});
  EXPECT_EQ(iors({30 * mm, 20 * mm, 0}), Iors{});        // beside the beaker
  EXPECT_EQ(iors({0, 40 * mm, 10 * mm}), Iors{});        // in it, above the water
  EXPECT_EQ(iors({0, 10 * mm, 15 * mm}), Iors{1.333f});  // in the water
  EXPECT_EQ(iors({0, 20 * mm, 26 * mm}), Iors{1.5f});    // in the wall
  EXPECT_EQ(iors({0, 20 * mm, 25.25 * mm}), (Iors{1.5f, 1.333f}));
  EXPECT_EQ(iors({10.5 * mm, 52 * mm, 0}), Iors{1.5f});  // in the rod
  EXPECT_EQ(iors({-6.75 * mm, 15.2 * mm, 0}), (Iors{1.5f, 1.333f}));
}

// What scenes do not need is left out.
TEST(Nested, OnlyWhereVolumesOverlap) {
  for (const auto& [scene, nested] : {std::pair("post", false), std::pair("shadow_sausage", false),
                                      std::pair("behind_glass", false), std::pair("beaker", true)}) {
    const auto setup = test::make_setup(scene, test::small_options(1000, 3, 3));
    EXPECT_EQ(!why_nested(setup->world, setup->settings.camera_media).empty(), nested) << scene;
  }
  const auto murky = test::make_setup("post", test::small_options(1000, 3, 3), [](Scene& scene) {
    for (Material& m : scene.materials)
      if (m.liquid) m.absorption = glm::dvec3(5);
  });
  EXPECT_EQ(why_nested(murky->world, murky->settings.camera_media), "the camera is in what absorbs");
}

}  // namespace
}  // namespace meniscal

// Extremes by the way that pictures go: menisci as the view needs them, the pilot, interreflection, passes, all layers.
#include <glm/gtc/constants.hpp>
#include <numeric>

#include "host/error.h"
#include "tests/extremes/extremes.h"

namespace meniscal::extremes {
namespace {

RenderOptions whole_options(std::uint32_t photons = 20000) {
  RenderOptions options;
  options.quality = Quality::draft;
  options.photons = photons;
  options.resolution = Resolution{48, 36};
  options.aovs = aov_names();
  return options;
}

// Expects finite numbers in all layers.
Image render_whole(const Scene& scene, bool on_gpu, const RenderOptions& options = whole_options(),
                   std::uint32_t passes = 2) {
  const World world = build_world(options, scene);
  RenderSettings settings = choose_settings(options, scene, world);
  const std::unique_ptr<Backend> backend = test::make_backend(on_gpu, world, settings);
  focus(settings, options, world, *backend);
  Film film(settings.crop, options.aovs, options.map_scale, scene.origin);
  render_passes(*backend, {0, passes}, film, [](const Tallies&) { return true; });
  const Image image = film.image(settings.width, settings.height);
  for (const Layer& layer : image.layers)
    EXPECT_TRUE(std::all_of(layer.pixels.begin(), layer.pixels.end(), [](float v) { return std::isfinite(v); }))
        << layer.name;
  return image;
}

Scene scene_of(const std::string& name, double brightness = 1) {
  Scene scene = load_gltf(std::string(SCENES) + "/" + name + ".gltf");
  for (PunctualLight& l : scene.lights) l.intensity *= brightness;
  for (Material& m : scene.materials) m.emission *= brightness;
  return scene;
}

glm::dvec3 middle(const Picture& positions) {
  return std::accumulate(positions.begin(), positions.end(), glm::dvec3(0)) / double(positions.size());
}

class Brightness : public testing::TestWithParam<double> {};

TEST_P(Brightness, ScalesThePictureOfAWholeRun) {
  REQUIRE_DEVICE();
  for (const char* name : {"shadow_sausage", "area_light"})
    for (const bool on_gpu : {false, true}) {
      const Picture usual = layer_of(render_whole(scene_of(name), on_gpu), "");
      const Picture other = layer_of(render_whole(scene_of(name, GetParam()), on_gpu), "");
      EXPECT_LT(relative_rms(scaled(other, 1 / GetParam()), usual), 1e-3) << name << (on_gpu ? ", GPU" : "");
    }
}
INSTANTIATE_TEST_SUITE_P(Factors, Brightness, testing::Values(1e-20, 1e20));

// A part of 16,384 pixels squared shows what one pixel of 512 squared shows: that one and those beside it, for less
// noise.
TEST(Picture, MayBeAPartOfSixteenThousandSquared) {
  REQUIRE_DEVICE();
  constexpr int side = 512, part = 32;
  const Scene scene = scene_of("post");
  for (const int pixel : {1, 200, 510}) {
    // Of a picture `by` times as wide as `side`, what the pixels `first` to `last` across and down show of that.
    const auto show = [&](int by, int first, int last, std::uint32_t samples, std::uint32_t passes, bool on_gpu) {
      RenderOptions options = whole_options(50000);
      options.diffuse_bounces = 0;
      options.resolution = Resolution{side * by, side * by};
      options.samples = samples;
      const auto from = std::uint32_t(by * first), to = std::uint32_t(by * (last + 1));
      options.crop = Crop{from, from, to, to};
      return render_whole(scene, on_gpu, options, passes);
    };
    const Image coarse = show(1, pixel - 1, pixel + 1, 16, 8, true);
    const Image cpu = show(part, pixel, pixel, 1, 2, false), gpu = show(part, pixel, pixel, 1, 2, true);
    const double difference = relative_rms(layer_of(gpu, ""), layer_of(cpu, ""), 0.01);
    std::printf("pixel %d: GPU off by %.2g\n", pixel, difference);
    EXPECT_LT(difference, 1e-3);
    for (const Image& fine : {cpu, gpu}) {
      std::printf("%.4g, as one %.4g\n", mean(layer_of(fine, "")), mean(layer_of(coarse, "")));
      EXPECT_NEAR(mean(layer_of(fine, "")) / mean(layer_of(coarse, "")), 1, 0.02);
      const glm::dvec3 off = middle(layer_of(fine, "position")) - middle(layer_of(coarse, "position"));
      EXPECT_LT(glm::length(off), 0.1 * 2 * scene.cameras[0].xmag / side) << "a tenth of a coarse pixel's width";
    }
  }
}

// The floor of a dish 10 mm deep and a wall of ten metres, in water that rises at it as said.
std::unique_ptr<test::Setup> beside_a_wall(MeniscusModel model, double capillary_length, double contact_angle) {
  RenderOptions options = test::small_options(100000, 16, 16);
  options.meniscus = model;
  return test::make_setup("post", options, [&](Scene& scene) {
    constexpr double deep = 0.01;
    make_floor(scene, 6, 2.5);
    PunctualLight sun = point_light({0, 0, 0}, 1);
    sun.type = PunctualLight::Type::directional;
    sun.direction = {0, -1, 0};
    scene.lights = {sun};
    test::look_down_on(scene, {2.5, 0.5 * deep, 0}, 2.5);
    Material wall = scene.materials[0];
    wall.name = "wall";
    wall.contact_angle = contact_angle;
    Material water = test::make_clear("water", 1.333);
    water.liquid.emplace();
    water.liquid->kind = "custom", water.liquid->density = 1000;
    water.liquid->surface_tension = 1000 * scene.gravity * capillary_length * capillary_length;
    scene.materials.insert(scene.materials.end(), {wall, water});
    scene.objects.push_back(test::make_box("wall", 1, {-1, -1, -5}, {0, 1, 5}));
    Object sheet;
    sheet.name = "water", sheet.material = 2;
    sheet.mesh.positions = {{-0.5, deep, -5.5}, {-0.5, deep, 5.5}, {5.5, deep, 5.5}, {5.5, deep, -5.5}};
    sheet.mesh.normals.assign(4, {0, 1, 0});
    sheet.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.objects.push_back(sheet);
  });
}

constexpr double micrometre = 1e-6;

TEST(Wall, OfTenMetresHasAMeniscusOfAMicrometre) {
  REQUIRE_DEVICE();
  constexpr double length = 2.7e-3;
  // A straight wall's rises by sqrt(2 (1 - sin theta)) capillary lengths.
  const double angle = glm::degrees(std::asin(1 - 0.5 * std::pow(micrometre / length, 2)));
  const Both level = render_both(*beside_a_wall(MeniscusModel::none, length, angle), 5e-3);
  for (const MeniscusModel model : {MeniscusModel::paper, MeniscusModel::exact}) {
    const auto setup = beside_a_wall(model, length, angle);
    ASSERT_EQ(setup->world.liquids.at(0).contacts.size(), 1u);
    const double rise = setup->world.liquids[0].contacts[0].rise_max;  // the paper's goes by the angle itself
    EXPECT_NEAR(rise, (model == MeniscusModel::paper ? 2 / glm::pi<double>() : 1) * micrometre, 0.02 * micrometre);
    const Both curved = render_both(*setup, 5e-3);
    EXPECT_NEAR(mean(curved.cpu) / mean(level.cpu), 1, 0.01);
    EXPECT_NEAR(mean(curved.gpu) / mean(level.gpu), 1, 0.01);
  }
}

TEST(Wall, OfTenMetresIsTooLongForAMeniscusAMicrometreWide) {
  for (const MeniscusModel model : {MeniscusModel::paper, MeniscusModel::exact}) {
    try {
      beside_a_wall(model, micrometre, 30);
      ADD_FAILURE() << "built";
    } catch (const Error& error) {
      EXPECT_EQ(error.code, ExitCode::scene);
      EXPECT_NE(std::string(error.what()).find("over a million times as long"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace meniscal::extremes

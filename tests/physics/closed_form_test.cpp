// Light against closed forms: glass slabs, the rainbow, area lights, and the floor under flat water.
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <numeric>

#include "host/reference/optics.h"
#include "host/reference/photons.h"
#include "tests/support/scene_objects.h"
#include "tests/support/scene_setup.h"

namespace meniscal {
namespace {

constexpr double mm = 1e-3, pi = glm::pi<double>();

double landed(const Tally& t) { return std::accumulate(t.flux_landed.begin(), t.flux_landed.end(), 0.0); }

// The floor alone, in the scene's own coordinates, at its depth of 50 mm under a vertical sun; `size`: its half-width.
void bare_floor(Scene& scene, double size) {
  std::erase_if(scene.objects, [](const Object& o) { return o.name != "floor"; });
  test::move(scene, "floor", {size / (32 * mm), 1, size / (32 * mm)}, {});
  for (Object& o : scene.objects)
    for (glm::dvec3& p : o.mesh.positions) p += scene.origin;
  scene.origin = glm::dvec3(0);
}

int add_material(Scene& scene, const Material& material) {
  scene.materials.push_back(material);
  return static_cast<int>(scene.materials.size()) - 1;
}

// Of light on a slab, its faces reflect a part R each, and all that goes to and fro within adds up: (1 - R) / (1 + R)
// goes through, the rest back.
class Slab : public testing::TestWithParam<double> {};

TEST_P(Slab, LetsTheFresnelSeriesThrough) {
  REQUIRE_DEVICE();
  const double angle = glm::radians(GetParam());
  const auto setup = test::make_setup("flat_water", test::small_options(200000, 8, 8), [&](Scene& scene) {
    bare_floor(scene, 2000 * mm);
    scene.lights[0].direction = {std::sin(angle), -std::cos(angle), 0};
    scene.objects.push_back(test::make_box("slab", add_material(scene, test::make_clear("glass", 1.5)),
                                           {-200 * mm, -0.1 * mm, -200 * mm}, {200 * mm, 0, 200 * mm}));
  });
  GpuBackend gpu(gpu::Device::open("auto"), setup->world, setup->settings);
  const Tally t = test::render_pass(gpu, 0).tallies[shared::MAP_CAUSTIC];
  const double once = reference::fresnel_reflectance(std::cos(angle), 1 / 1.5), through = (1 - once) / (1 + once);
  std::printf("%.5f goes through, %.5f by hand\n", landed(t) / t.flux_in, through);
  EXPECT_NEAR(landed(t) / t.flux_in, through, 0.002);
}
INSTANTIATE_TEST_SUITE_P(Degrees, Slab, testing::Values(0.0, 30.0, 60.0, 75.0),
                         [](const auto& tested) { return std::to_string(int(tested.param)); });

// The primary rainbow: light once reflected inside a ball of water gathers where it is deflected least. Its angle from
// the point opposite the sun is 4 r - 2 i, with cos^2 i = (n^2 - 1) / 3.
class Rainbow : public testing::TestWithParam<double> {};

TEST_P(Rainbow, StandsAtTheAngleOfLeastDeflection) {
  const double ior = GetParam(), i = std::acos(std::sqrt((ior * ior - 1) / 3)), r = std::asin(std::sin(i) / ior);
  const double expected = glm::degrees(4 * r - 2 * i);
  EXPECT_NEAR(expected, ior < 1.337 ? 42.4 : 40.6, 0.1);
  // Normals that are interpolated, on a ball of so many facets, err by hundredths of a degree.
  const auto setup = test::make_setup("sphere", test::small_options(1000, 8, 8), [&](Scene& scene) {
    std::erase_if(scene.objects, [](const Object& o) { return o.name != "sphere"; });
    const int water = add_material(scene, test::make_clear("drop", ior));
    scene.objects[0].material = water;
  });
  ASSERT_EQ(setup->world.strata.size(), 1u);
  const reference::Tracer tracer(setup->world);
  // Rays of one azimuth, evenly over the ball's disc; those that go through, are reflected inside once, and leave.
  constexpr int rays = 40000, bins = 900;
  std::vector<double> light(bins);
  const double radius = 4 * mm;
  for (int k = 0; k < rays; ++k) {
    const double b = std::sqrt((k + 0.5) / rays), turn = 2.399963 * k;
    reference::Path path;
    path.ray = {glm::dvec3(b * radius * std::cos(turn), 2 * radius, b * radius * std::sin(turn)) - setup->scene.origin,
                {0, -1, 0}};
    double weight = 1;
    int inside = 0;
    for (const double way : {1.0, 0.0, 1.0}) {  // in, reflected, out
      const auto hit = tracer.closest(path.ray, INFINITY, path.triangle);
      if (!hit) break;
      const shared::Surface& surface = setup->world.surfaces[setup->world.triangles[hit->triangle].material];
      const double reflectance = reference::scatter_specular(path, *hit, surface, tracer, way, glm::dvec2(0));
      weight *= way > 0 ? 1 - reflectance : reflectance;
      ++inside;
    }
    if (inside < 3 || !(weight > 0)) continue;
    const double angle = glm::degrees(std::acos(glm::clamp(path.ray.direction.y, -1.0, 1.0)));
    if (angle < 45) light[static_cast<std::size_t>(angle / 45 * bins)] += weight / std::sin(glm::radians(angle));
  }
  const double brightest = 45 * (double(std::max_element(light.begin(), light.end()) - light.begin()) + 0.5) / bins;
  std::printf("n %.3f: %.2f degrees, %.2f by hand\n", ior, brightest, expected);
  EXPECT_NEAR(brightest, expected, 0.2);
  // Beyond it, nothing.
  const auto beyond = static_cast<std::ptrdiff_t>((expected + 0.5) / 45 * bins);
  EXPECT_LT(std::accumulate(light.begin() + beyond, light.end(), 0.0),
            0.01 * std::accumulate(light.begin(), light.end(), 0.0));
}
INSTANTIATE_TEST_SUITE_P(Colours, Rainbow, testing::Values(1.331, 1.343),
                         [](const auto& tested) { return tested.param < 1.337 ? "red" : "violet"; });

// Form factors of a rectangle a x b seen from under its corner at distance c: facing it, and standing at right angles
// to it along the side b (Howell, "A Catalog of Radiation Heat Transfer Configuration Factors", B-3 and B-4).
double facing(double a, double b, double c) {
  const double x = a / c, y = b / c;
  return (x / std::sqrt(1 + x * x) * std::atan(y / std::sqrt(1 + x * x)) +
          y / std::sqrt(1 + y * y) * std::atan(x / std::sqrt(1 + y * y))) /
         (2 * pi);
}
double upright(double a, double b, double c) {
  return (std::atan(b / c) - c / std::hypot(a, c) * std::atan(b / std::hypot(a, c))) / (2 * pi);
}

TEST(FormFactor, OfASquareLamp) {
  REQUIRE_DEVICE();
  for (const bool wall : {false, true}) {
    SCOPED_TRACE(wall ? "wall" : "floor");
    // A lamp 30 mm square, 40 mm above the place that the camera sees, a hundredth of a millimetre wide.
    RenderOptions options = test::small_options(1000, 8, 8);
    options.samples = 64;
    const auto setup = test::make_setup("area_light", options, [&](Scene& scene) {
      std::erase_if(scene.objects, [](const Object& o) { return o.name != "floor" && o.name != "lamp"; });
      for (Object& o : scene.objects)
        for (glm::dvec3& p : o.mesh.positions) p += scene.origin;
      scene.origin = glm::dvec3(0);
      test::move(scene, "lamp", {1, 0, 1}, {wall ? 15 * mm : 0, -10 * mm, 0});
      if (wall)
        for (Object& o : scene.objects)
          if (o.name == "floor") {
            for (glm::dvec3& p : o.mesh.positions) p = {0, p.x - 50 * mm, p.z};
            for (glm::dvec3& n : o.mesh.normals) n = {-1, 0, 0};
          }
      test::look_down_on(scene, {0, -45 * mm, 0}, 5e-6);
      if (wall) {
        // From +x on the wall x = 0.
        scene.cameras[0].pose = glm::dmat4(glm::dvec4(0, 0, -1, 0), glm::dvec4(0, 1, 0, 0), glm::dvec4(1, 0, 0, 0),
                                           glm::dvec4(5 * mm, -50 * mm, 0, 1));
      }
    });
    GpuBackend gpu(gpu::Device::open("auto"), setup->world, setup->settings);
    Film film(setup->settings.crop, {"irradiance"}, {});
    render_passes(gpu, {0, 8}, film, [](const Tallies&) { return true; });
    const std::vector<float> pixels = film.image(8, 8).find("irradiance")->pixels;
    const double irradiance = std::accumulate(pixels.begin(), pixels.end(), 0.0) / double(pixels.size());
    const double radiance = mean_of(setup->world.lights[0].intensity), half = 15 * mm, c = 40 * mm;
    const double expected = pi * radiance * (wall ? 2 * upright(2 * half, half, c) : 4 * facing(half, half, c));
    std::printf("irradiance %.5f, %.5f by hand\n", irradiance, expected);
    EXPECT_NEAR(irradiance, expected, 0.003 * expected);
  }
}

// Irradiance on a floor right under a small light of intensity 1 cd, `height` over water `depth` deep: rays spread as
// if the water were depth / n deep.
double under_water(double height, double depth) {
  const double n = 1.333, once = (n - 1) / (n + 1);
  return (1 - once * once) / std::pow(height + depth / n, 2);
}

class FlatWater : public testing::TestWithParam<std::string> {};

TEST_P(FlatWater, LightsTheFloorBelow) {
  REQUIRE_DEVICE();
  const std::string& type = GetParam();
  const double height = 100 * mm, depth = 50 * mm, lamp = 4 * mm;
  RenderOptions options = test::small_options(300000, 8, 8);
  options.radius = 0.5 * mm;
  const auto setup = test::make_setup(type == "area" ? "area_light" : "flat_water", options, [&](Scene& scene) {
    std::erase_if(scene.objects, [](const Object& o) { return o.name.starts_with("post"); });
    test::move(scene, "water", {0.25, 1, 0.25}, {});
    test::move(scene, "lamp", {lamp / (30 * mm), 1, lamp / (30 * mm)}, {});
    for (PunctualLight& l : scene.lights) {
      l.position = glm::dvec3(0, height, 0) - scene.origin;
      l.direction = {0, -1, 0};
      if (type == "point") l.type = PunctualLight::Type::point;
      if (type == "spot") l.type = PunctualLight::Type::spot, l.inner_cone = 0.3, l.outer_cone = 0.4;
    }
    test::look_down_on(scene, {0, -20 * mm, 0}, 1 * mm);
  });
  GpuBackend gpu(gpu::Device::open("auto"), setup->world, setup->settings);
  Film film(setup->settings.crop, {"irradiance"}, {});
  render_passes(gpu, {0, 4}, film, [](const Tallies&) { return true; });
  const std::vector<float> pixels = film.image(8, 8).find("irradiance")->pixels;
  const double irradiance = std::accumulate(pixels.begin(), pixels.end(), 0.0) / double(pixels.size());
  double expected = mean_of(setup->world.lights[0].intensity);
  if (type == "directional") expected *= 0.979627;
  if (type == "point" || type == "spot") expected *= under_water(height, depth);
  if (type == "area") expected *= lamp * lamp * under_water(height, depth);
  std::printf("%s: irradiance %.5g, %.5g by hand (%+.2f %%)\n", type.c_str(), irradiance, expected,
              100 * (irradiance / expected - 1));
  EXPECT_NEAR(irradiance, expected, 0.005 * expected);
}
INSTANTIATE_TEST_SUITE_P(Lights, FlatWater, testing::Values("directional", "point", "spot", "area"),
                         [](const auto& tested) { return tested.param; });

}  // namespace
}  // namespace meniscal

// Suns that are discs and light from all round, against closed forms.
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/scene_setup.h"
#include "tests/support/skies.h"

namespace meniscal {
namespace {

using glm::dvec3;
constexpr double pi = glm::pi<double>(), mm = 1e-3, water_ior = 1.333;

// The floor of albedo 0.5, 50 mm below the camera's plane; with the water, if asked for. Both are `wider` than the
// file's.
std::unique_ptr<test::Setup> make_floor(const RenderOptions& options, bool water, double wider,
                                        const std::function<void(Scene&)>& edit) {
  return test::make_setup("flat_water", options, [&](Scene& scene) {
    std::erase_if(scene.objects, [&](const Object& o) { return o.name != "floor" && !water; });
    for (Object& o : scene.objects)
      for (dvec3& p : o.mesh.positions) p *= dvec3(wider, 1, wider);
    edit(scene);
  });
}

void shine_from(Scene& scene, const dvec3& towards, double diameter) {
  scene.lights[0].direction = -glm::normalize(towards);
  scene.lights[0].intensity = dvec3(1);
  test::widen_suns(scene, diameter);
}

Image render_image(const test::Setup& setup, bool on_gpu, std::uint32_t passes, const std::vector<std::string>& aovs) {
  const std::unique_ptr<Backend> backend = test::make_backend(on_gpu, setup.world, setup.settings);
  Film film(setup.settings.crop, aovs, {});
  render_passes(*backend, {0, passes}, film, [](const Tallies&) { return true; });
  return film.image(setup.settings.width, setup.settings.height);
}

// Means over the image and all passes, of the red channel.
struct Means {
  double direct, caustic, radiance, noise;  // noise: of the radiance's mean, absolute
};
Means render(const test::Setup& setup, bool on_gpu, std::uint32_t passes) {
  const std::unique_ptr<Backend> backend = test::make_backend(on_gpu, setup.world, setup.settings);
  Means means{};
  double squares = 0;
  for (std::uint32_t pass = 0; pass < passes; ++pass) {
    const auto samples = test::render_pass(*backend, pass).samples;
    double radiance = 0;
    const double part = 1 / double(samples.size() * passes);
    for (const shared::PixelSample& s : samples) {
      means.direct += part * double(s.direct.x);
      means.caustic += part * double(s.caustic.x);
      radiance += part * passes * double(s.emitted.x + s.weight.x * (s.direct.x + s.targeted.x + s.caustic.x));
    }
    means.radiance += radiance / passes;
    squares += radiance * radiance / passes;
  }
  means.noise = std::sqrt(std::max(squares - means.radiance * means.radiance, 0.0) / std::max(passes - 1, 1u));
  return means;
}

TEST(Sun, LightsAFloorByTheCosine) {
  REQUIRE_DEVICE();
  for (const double diameter : {0.53, 10.0, 60.0})
    for (const double angle : {0.0, 0.9}) {
      const auto setup = make_floor(test::small_options(0, 96, 96), false, 1, [&](Scene& scene) {
        shine_from(scene, dvec3(std::sin(angle), std::cos(angle), 0), diameter);
      });
      for (const bool on_gpu : {true, false}) {
        const Means means = render(*setup, on_gpu, 2);
        // Of the cosine over the cone the standard deviation is sin(angle) sin(half) / 2 and less.
        const double tolerance = 4 * std::sin(glm::radians(diameter) / 2) / 2 / std::sqrt(96 * 96 * 2) + 1e-5;
        EXPECT_NEAR(means.direct, std::cos(angle), tolerance) << diameter << " degrees, from " << angle;
      }
    }
}

// Half the sky's disc is hidden below a straight edge; to the sides, what a chord leaves of it.
TEST(Sun, EdgesHavePenumbras) {
  REQUIRE_DEVICE();
  constexpr double diameter = 2, height = 48 * mm;
  const double half_width = height * std::tan(glm::radians(diameter) / 2);
  RenderOptions options = test::small_options(0, 40, 40);
  options.samples = 64;
  const auto setup = make_floor(options, false, 1, [&](Scene& scene) {
    shine_from(scene, dvec3(0, 1, 0), diameter);
    scene.cameras[0].xmag = scene.cameras[0].ymag = 1.5 * half_width;
    Object roof = scene.objects[0];
    roof.name = "roof";
    for (dvec3& p : roof.mesh.positions) p += dvec3(-(p.x + scene.origin.x < 0 ? p.x + scene.origin.x : 0), height, 0);
    scene.objects.push_back(roof);
  });
  for (const bool on_gpu : {true, false}) {
    SCOPED_TRACE(on_gpu ? "GPU" : "reference");
    const std::unique_ptr<Backend> backend = test::make_backend(on_gpu, setup->world, setup->settings);
    std::vector<double> measured(40), expected(40);
    const auto samples = test::render_pass(*backend, 1).samples;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double x = double(samples[i].position.x) + setup->scene.origin.x;
      const double a = glm::clamp(-x / half_width, -1.0, 1.0);
      measured[i % 40] += double(samples[i].direct.x) / (40 * 64);
      expected[i % 40] += (0.5 + (a * std::sqrt(1 - a * a) + std::asin(a)) / pi) / (40 * 64);
    }
    EXPECT_GT(*std::max_element(expected.begin(), expected.end()), 0.99);
    EXPECT_LT(*std::min_element(expected.begin(), expected.end()), 0.01);
    // 2560 samples a column: 0.01 is the standard deviation, at the most.
    for (int c = 0; c < 40; ++c) EXPECT_NEAR(measured[c], expected[c], 0.045) << "column " << c;
    double mean_difference = 0;
    for (int c = 0; c < 40; ++c) mean_difference += std::abs(measured[c] - expected[c]) / 40;
    EXPECT_LT(mean_difference, 0.012);
  }
}

// Radiance 1 all round: a floor below half of it has albedo times 1.
TEST(Environment, UniformLightsAFloorByItsAlbedo) {
  REQUIRE_DEVICE();
  const auto setup = make_floor(test::small_options(0, 96, 96), false, 1, [&](Scene& scene) {
    test::light_by(scene, test::make_sky(16, 8, [](int, int) { return glm::vec3(1); }));
  });
  for (const bool on_gpu : {true, false}) {
    // Uniform over the sphere, 4 pi cos: the standard deviation is 1.29 of the mean.
    const Means means = render(*setup, on_gpu, 8);
    EXPECT_NEAR(means.radiance, 0.5, 4 * 0.5 * 1.29 / std::sqrt(96 * 96 * 8));
  }
}

// A box that is white, and one that is grey, in light from all round: it sees no light but the sky's.
TEST(Environment, IsAFurnaceForConvexSolids) {
  REQUIRE_DEVICE();
  for (const double albedo : {1.0, 0.5})
    for (const auto& [integrator, on_gpu] :
         {std::pair(Integrator::targeted, true), std::pair(Integrator::targeted, false),
          std::pair(Integrator::path, false)}) {
      RenderOptions options = test::small_options(4000, 64, 48);
      options.diffuse_bounces = 4;
      options.integrator = integrator;
      const auto setup = test::make_setup("box", options, [&](Scene& scene) {
        std::erase_if(scene.objects, [](const Object& o) { return o.name != "box"; });
        for (Material& m : scene.materials) m.base_color = dvec3(albedo);
        test::light_by(scene, test::make_sky(16, 8, [](int, int) { return glm::vec3(1); }));
        Camera& camera = scene.cameras[0];
        camera.orthographic = false;
        camera.yfov = 0.5;
        camera.pose = glm::inverse(glm::lookAt(dvec3(10, 20, 30) * mm - scene.origin, -scene.origin, dvec3(0, 1, 0)));
      });
      const Image image = render_image(*setup, on_gpu, 4, {"depth"});
      double on_box = 0;
      int box = 0, beyond = 0;
      for (std::size_t i = 0; i < image.pixel_count(); ++i) {
        const float radiance = image.layers[0].pixels[3 * i];
        const double depth = double(image.find("depth")->pixels[i]);
        if (depth > 30 * mm) {
          on_box += double(radiance);
          ++box;
        } else if (depth == 0) {
          EXPECT_EQ(radiance, 1);
          ++beyond;
        }
      }
      ASSERT_GT(box, 400);
      ASSERT_GT(beyond, 400);
      EXPECT_NEAR(on_box / box, albedo, 4 * albedo * 1.29 / std::sqrt(4 * box));
    }
}

// One bright pixel lights as its solid angle does.
TEST(Environment, BrightPixelIsASun) {
  REQUIRE_DEVICE();
  constexpr int rows = 32, row = 5;
  constexpr double radiance = 200, high = pi * row / rows, low = pi * (row + 1) / rows;
  const double irradiance =
      radiance * pi / rows * (std::pow(std::cos(high), 2) - std::pow(std::cos(low), 2)) / 2;  // of cos over the pixel
  const auto setup = make_floor(test::small_options(0, 96, 96), false, 1, [&](Scene& scene) {
    test::light_by(scene, test::make_sky(2 * rows, rows, [](int r, int c) {
                     return glm::vec3(r == row && c == 11 ? float(radiance) : 0.0f);
                   }));
  });
  for (const bool on_gpu : {true, false}) EXPECT_NEAR(render(*setup, on_gpu, 2).direct, irradiance, 1e-3 * irradiance);
}

// Fresnel's formulas by angles, from air into water.
double transmittance(double angle) {
  if (angle < 1e-6) return 1 - std::pow((water_ior - 1) / (water_ior + 1), 2);
  const double beyond = std::asin(std::sin(angle) / water_ior);
  const double s = std::sin(angle - beyond) / std::sin(angle + beyond),
               p = std::tan(angle - beyond) / std::tan(angle + beyond);
  return 1 - (s * s + p * p) / 2;
}

// Of uniform light.
double diffuse_transmittance() {
  constexpr int n = 2000;
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += transmittance(std::asin(std::sqrt((i + 0.5) / n)));  // by projected solid angle
  return sum / n;
}

// A floor under water that is wide enough for all that is bent to it: what the surface lets through, whoever sends the
// photons.
class UnderWater : public testing::TestWithParam<Integrator> {};

TEST_P(UnderWater, FloorGetsWhatTheSurfaceLetsThrough) {
  REQUIRE_DEVICE();
  RenderOptions options = test::small_options(400000, 24, 24);
  options.integrator = GetParam();
  const auto irradiance = [&](const std::function<void(Scene&)>& edit) {
    const auto setup = make_floor(options, true, 4, edit);
    const Means means = render(*setup, true, 6);
    return std::pair(means.caustic, means.noise * pi / 0.5);
  };

  const double diffuse = diffuse_transmittance();
  EXPECT_NEAR(diffuse, 0.934, 0.001) << "1 - the diffuse reflectance of water, as tabulated";
  const auto [sky, sky_noise] = irradiance([](Scene& scene) {
    test::light_by(scene, test::make_sky(16, 8, [](int row, int) { return glm::vec3(row < 4 ? 1.0f : 0.0f); }));
  });
  std::printf("sky: %.5f +- %.5f, expected %.5f\n", sky, sky_noise, pi * diffuse);
  EXPECT_NEAR(sky, pi * diffuse, 4 * sky_noise + 0.005 * pi);
  EXPECT_LT(sky_noise, 0.01 * pi);

  for (const double diameter : {0.53, 8.0, 20.0}) {
    constexpr double angle = 0.6;
    const auto [sun, sun_noise] =
        irradiance([&](Scene& scene) { shine_from(scene, dvec3(std::sin(angle), std::cos(angle), 0), diameter); });
    // Over the disc the transmittance hardly changes: 3e-4 at 20 degrees.
    const double expected = std::cos(angle) * transmittance(angle);
    std::printf("sun of %g degrees: %.5f +- %.5f, expected %.5f\n", diameter, sun, sun_noise, expected);
    EXPECT_NEAR(sun, expected, 4 * sun_noise + 0.004 * expected);
    EXPECT_LT(sun_noise, 0.01);
  }
}
// Light from below, within the water, that is mirrored beyond the critical angle: a ceiling just above gets the same
// part of it, over n^2.
TEST_P(UnderWater, LightFromBelowComesOutInSnellsCone) {
  REQUIRE_DEVICE();
  RenderOptions options = test::small_options(400000, 8, 8);
  options.integrator = GetParam();
  const auto setup = make_floor(options, true, 4, [](Scene& scene) {
    for (Object& o : scene.objects)
      if (o.name == "floor")
        for (dvec3& p : o.mesh.positions) p.y += 52 * mm;
    test::light_by(scene, test::make_sky(16, 8, [](int row, int) { return glm::vec3(row < 4 ? 0.0f : 1.0f); }));
  });
  const std::unique_ptr<Backend> backend = test::make_backend(true, setup->world, setup->settings);
  double landed = 0;
  for (std::uint32_t pass = 0; pass < 4; ++pass) {
    const Tallies tallies = test::render_pass(*backend, pass).tallies;
    for (const double flux : tallies[shared::MAP_CAUSTIC].flux_landed) landed += flux / 4;
  }
  const double area = std::pow(0.24, 2), expected = area * pi * diffuse_transmittance() / (water_ior * water_ior);
  std::printf("landed %.6f, expected %.6f\n", landed, expected);
  EXPECT_NEAR(landed, expected, 0.01 * expected);
}

INSTANTIATE_TEST_SUITE_P(Integrators, UnderWater, testing::Values(Integrator::targeted, Integrator::ordinary),
                         [](const auto& tested) {
                           return tested.param == Integrator::ordinary ? "ordinary" : "targeted";
                         });

// Water with a meniscus, caustics and interreflection: by photons from the targets, from the lights alone, and by path
// tracing, one answer.
class OneAnswerOutdoors : public testing::TestWithParam<const char*> {};

TEST_P(OneAnswerOutdoors, OfPhotonsAndPaths) {
  REQUIRE_DEVICE();
  RenderOptions options = test::small_options(200000, 48, 36);
  options.diffuse_bounces = 2;
  options.quality = Quality::draft;
  const test::NamedLight named = test::named_light(GetParam());
  const auto radiance_by = [&](Integrator integrator, std::uint32_t samples, std::uint32_t passes) {
    options.integrator = integrator;
    options.samples = samples;
    const auto setup = test::make_setup(named.file, options, named.edit);
    if (integrator != Integrator::path)
      setup->settings.split = 1;  // the mirror image of what is bright is no speck then
    const Image image = render_image(*setup, integrator != Integrator::path, passes, {});
    double sum = 0;
    for (const float v : image.layers[0].pixels) sum += double(v) / double(image.layers[0].pixels.size());
    return sum;
  };
  const double path = radiance_by(Integrator::path, 200, 1);
  const double targeted = radiance_by(Integrator::targeted, 4, 4);
  const double ordinary = radiance_by(Integrator::ordinary, 4, 8);
  std::printf("radiance: path %.5f, targeted %.5f, ordinary %.5f\n", path, targeted, ordinary);
  EXPECT_NEAR(targeted, path, 0.03 * path);
  EXPECT_NEAR(ordinary, path, 0.03 * path);
}
INSTANTIATE_TEST_SUITE_P(Scenes, OneAnswerOutdoors, testing::Values("shadow_sausage-wide_sun", "shadow_sausage-day"),
                         test::name_of_test);

// From below the water the whole sky is within Snell's window; beyond it, the surface mirrors the dark.
TEST(Environment, IsSeenThroughSnellsWindow) {
  REQUIRE_DEVICE();
  RenderOptions options = test::small_options(0, 64, 64);
  options.samples = 1;
  options.specular_bounces = 1;
  const auto setup = make_floor(options, true, 40, [&](Scene& scene) {
    std::erase_if(scene.objects, [](const Object& o) { return o.name == "floor"; });
    test::light_by(scene, test::make_sky(64, 32, [](int row, int) { return glm::vec3(row < 16 ? 2.0f : 0.0f); }));
    Camera& camera = scene.cameras[0];
    camera.orthographic = false;
    camera.yfov = 2;
    camera.pose = glm::dmat4(glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 0, 1, 0), glm::dvec4(0, -1, 0, 0),
                             glm::dvec4(-scene.origin + dvec3(0, -20 * mm, 0), 1));
  });
  const CameraAxes axes = camera_axes(setup->settings.camera, 64, 64);
  for (const bool on_gpu : {true, false}) {
    const std::unique_ptr<Backend> backend = test::make_backend(on_gpu, setup->world, setup->settings);
    const auto samples = backend->trace_camera(0, {0, shared::BRANCH_THROUGH_ALL});
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double x = (double(i % 64) + 0.5) / 32 - 1, y = 1 - (double(i / 64) + 0.5) / 32;
      const dvec3 w = glm::normalize(axes.forward + x * axes.right + y * axes.up);
      const double sine = water_ior * std::hypot(w.x, w.z);
      if (std::abs(sine - 1) < 0.02) continue;
      const double expected = sine < 1 ? 2 * transmittance(std::asin(sine)) * water_ior * water_ior : 0;
      EXPECT_NEAR(double(samples[i].emitted.x), expected, 1e-4) << "pixel " << i;
    }
  }
}

}  // namespace
}  // namespace meniscal

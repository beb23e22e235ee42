// Highlights, lights seen in menisci: against many plain camera rays, also through glass and from under water, under a
// moving camera, on the GPU and the CPU path.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "host/render/highlights.h"
#include "tests/support/scene_objects.h"
#include "tests/support/scene_setup.h"
#include "tests/support/textured_scene.h"

namespace meniscal {
namespace {

constexpr double degree = glm::pi<double>() / 180;

RenderOptions options_for(std::uint32_t highlight_samples) {
  RenderOptions options = test::small_options(1000, 320, 240);
  options.meniscus = MeniscusModel::exact;
  options.highlight_samples = highlight_samples;
  return options;
}

std::unique_ptr<test::Setup> make_setup(const std::string& name, const Crop& crop, std::uint32_t highlight_samples,
                                        const std::function<void(Scene&)>& edit = {}) {
  RenderOptions options = options_for(highlight_samples);
  options.crop = crop;
  return test::make_setup(name, options, edit);
}

// The tank's lamp round its post; a sun as wide as that lamp, in the dish where the rod pierces the water.
const Crop tank_crop{138, 114, 150, 124}, dish_crop{156, 74, 174, 90};
std::function<void(Scene&)> sun_of(double angular_diameter) {
  return [=](Scene& scene) { scene.lights[0].angular_diameter = angular_diameter; };
}

// Radiances of emission in a pass, by pixel: what camera paths see, and highlights.
std::vector<glm::dvec3> emission(Backend& backend, const RenderSettings& settings, std::uint32_t pass) {
  std::vector<glm::dvec3> sums(settings.crop.pixels());
  backend.render_pass(pass, [&](const Samples& samples, const View& view) {
    for (std::size_t i = 0; i < sums.size(); ++i) {
      sums[i] += glm::dvec3(samples.pixels[i].emitted) / double(settings.samples);
      if (view.last_main(settings) && !samples.highlights.empty()) sums[i] += glm::dvec3(samples.highlights[i]);
    }
  });
  return sums;
}

std::vector<glm::dvec3> highlights(Backend& backend, std::uint32_t pass) {
  std::vector<glm::dvec3> found;
  backend.render_pass(pass, [&](const Samples& samples, const View&) {
    for (const glm::vec3& h : samples.highlights) found.emplace_back(h);
  });
  return found;
}

double total(const std::vector<glm::dvec3>& radiances) {
  double sum = 0;
  for (const glm::dvec3& r : radiances) sum += mean_of(r);
  return sum;
}

// Means over their supersampling, of hundreds of rays a pixel or thousands; it has no highlights of its own and the
// same paths otherwise.
void expect_as_plain_rays(const std::string& name, const Crop& crop, const std::function<void(Scene&)>& edit,
                          std::uint32_t rays = 4096) {
  const auto setup = make_setup(name, crop, 16, edit);
  ASSERT_EQ(setup->settings.highlight_cells, 4U);
  setup->settings.samples = rays;
  setup->settings.split = 2;
  RenderSettings plain = setup->settings;
  plain.highlights = shared::HIGHLIGHTS_NONE;
  GpuBackend gpu(gpu::Device::open("auto", true), setup->world, setup->settings);
  GpuBackend supersampled(gpu::Device::open("auto", true), setup->world, plain);
  const std::vector<glm::dvec3> shown = highlights(gpu, 0), a = emission(gpu, setup->settings, 0),
                                b = emission(supersampled, plain, 0);
  double square = 0, truth_square = 0, sum = 0, truth_sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    // Of what is seen in menisci: the rest is the same in both.
    const double is = mean_of(shown[i]), was = is - mean_of(a[i]) + mean_of(b[i]);
    square += (is - was) * (is - was);
    truth_square += was * was;
    sum += is;
    truth_sum += was;
  }
  ASSERT_GT(truth_sum, 0);
  EXPECT_LT(std::sqrt(square / truth_square), 0.05);
  EXPECT_NEAR(sum / truth_sum, 1, 0.01);
  testing::Test::RecordProperty("relative_rmse", fmt::format("{}", std::sqrt(square / truth_square)));
  testing::Test::RecordProperty("mean_ratio", fmt::format("{}", sum / truth_sum));
}

TEST(Highlights, OfALampAreAsThousandsOfRaysFindThem) {
  REQUIRE_DEVICE();
  expect_as_plain_rays("tank", tank_crop, {});
}

TEST(Highlights, OfAWideSunAreAsThousandsOfRaysFindThem) {
  REQUIRE_DEVICE();
  expect_as_plain_rays("shadow_sausage", dish_crop, sun_of(8 * degree));
}

// Through a thick pane.
TEST(Highlights, SeenThroughGlassAreAsThousandsOfRaysFindThem) {
  REQUIRE_DEVICE();
  expect_as_plain_rays("tank", tank_crop, [](Scene& scene) {
    Material glass = test::make_clear("glass", 1.5);
    glass.has_thickness = true;
    scene.materials.push_back(glass);
    const glm::dvec3 low = glm::dvec3(-0.01, 0.030, 0.018) - scene.origin,
                     high = glm::dvec3(0.03, 0.032, 0.036) - scene.origin;
    scene.objects.push_back(test::make_box("pane", static_cast<int>(scene.materials.size()) - 1, low, high));
  });
}

// Without thickness, coloured, and far from clear.
TEST(Highlights, SeenThroughASheetAreAsManyRaysFindThem) {
  REQUIRE_DEVICE();
  const auto hang_sheet = [](Scene& scene) {
    Material glass = test::make_clear("glass", 2);
    glass.base_color = {0.4, 0.7, 1};
    scene.materials.push_back(glass);
    scene.objects.push_back(test::make_quad("sheet", glm::dvec3(-0.01, 0.030, 0.018) - scene.origin, {0.04, 0, 0},
                                            {0, 0.004, 0.018}, static_cast<int>(scene.materials.size()) - 1));
  };
  expect_as_plain_rays("tank", tank_crop, hang_sheet, 1024);
}

// Steeply upwards, through the meniscus round the post.
TEST(Highlights, SeenFromUnderWaterAreAsManyRaysFindThem) {
  REQUIRE_DEVICE();
  const auto dive = [](Scene& scene) {
    const glm::dvec3 eye(0.008, -0.02, 0.012), met(0.002, 0.001, 0.004);
    scene.cameras[0].pose = glm::inverse(glm::lookAt(eye - scene.origin, met - scene.origin, glm::dvec3(0, 1, 0)));
  };
  expect_as_plain_rays("tank", {133, 86, 148, 96}, dive, 512);
}

TEST(Highlights, OfAnOrthographicCameraAreAsManyRaysFindThem) {
  REQUIRE_DEVICE();
  const auto flatten = [](Scene& scene) {
    sun_of(7 * degree)(scene);
    Camera& camera = scene.cameras[0];
    camera.orthographic = true;
    camera.xmag = 0.048, camera.ymag = 0.036;
  };
  expect_as_plain_rays("shadow_sausage", dish_crop, flatten, 512);
}

// Against cells 16 times finer along each side, too many rays for plain ones: of lights that no ray meets by chance.
TEST(Highlights, OfLightsWithoutExtentHangLittleOnTheirCells) {
  REQUIRE_DEVICE();
  const auto point_light = [](Scene& scene) {
    scene.lights[0].type = PunctualLight::Type::point;
    scene.lights[0].position = 0.8 * glm::dvec3(0, std::cos(25 * degree), -std::sin(25 * degree)) - scene.origin;
  };
  for (const auto& edit : {std::function<void(Scene&)>(), std::function<void(Scene&)>(point_light)}) {
    const auto coarse = make_setup("shadow_sausage", dish_crop, 16, edit),
               fine = make_setup("shadow_sausage", dish_crop, 4096, edit);
    GpuBackend a(gpu::Device::open("auto", true), coarse->world, coarse->settings);
    GpuBackend b(gpu::Device::open("auto", true), fine->world, fine->settings);
    const std::vector<glm::dvec3> shown = highlights(a, 0), truth = highlights(b, 0);
    double square = 0, truth_square = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      square += std::pow(mean_of(shown[i]) - mean_of(truth[i]), 2);
      truth_square += std::pow(mean_of(truth[i]), 2);
    }
    ASSERT_GT(truth_square, 0);
    EXPECT_LT(std::sqrt(square / truth_square), 0.05);
    EXPECT_NEAR(total(shown) / total(truth), 1, 0.01);
  }
}

// A light without extent has those of a sun of half a degree and the same irradiance.
TEST(Highlights, OfAParallelLightAreThoseOfANarrowSun) {
  REQUIRE_DEVICE();
  const auto parallel = make_setup("shadow_sausage", dish_crop, 64),
             sun = make_setup("shadow_sausage", dish_crop, 64, sun_of(0.5 * degree));
  GpuBackend a(gpu::Device::open("auto", true), parallel->world, parallel->settings);
  GpuBackend b(gpu::Device::open("auto", true), sun->world, sun->settings);
  EXPECT_NEAR(total(highlights(a, 0)) / total(highlights(b, 0)), 1, 0.01);
}

// Ten frames, each a tenth of a pixel further aside as the camera turns, and as many over a tenth of a pixel as it
// moves: the rim neither flickers nor crawls.
TEST(Highlights, StayWhileTheCameraMovesByPartsOfAPixel) {
  REQUIRE_DEVICE();
  for (const char* name : {"tank", "shadow_sausage"}) {
    const auto setup = make_setup(name, {0, 0, 320, 240}, 16);
    const CameraAxes axes = camera_axes(setup->settings.camera, 320, 240);
    const glm::dvec3 pixel = 2.0 / 320 * axes.right;
    const glm::dvec4 eye = setup->settings.camera.pose[3];
    const auto frames = [&](const std::function<void(Camera&, int)>& move) {
      std::vector<double> totals;
      for (int frame = 0; frame < 10; ++frame) {
        RenderSettings moved = setup->settings;
        move(moved.camera, frame);
        GpuBackend gpu(gpu::Device::open("auto", true), setup->world, moved);
        totals.push_back(total(highlights(gpu, 0)));
      }
      const auto [least, most] = std::minmax_element(totals.begin(), totals.end());
      EXPECT_GT(*least, 0);
      return *most / *least;
    };
    const double turned = frames([&](Camera& camera, int frame) {
      const double angle = 0.1 * frame * glm::length(pixel);
      camera.pose = glm::rotate(camera.pose, angle, glm::dvec3(0, 1, 0));
    });
    EXPECT_LT(turned, 1.02) << name;
    const double moved = frames([&](Camera& camera, int frame) {
      camera.pose[3] += 0.01 * frame * glm::length(glm::dvec3(eye)) * glm::dvec4(pixel, 0);
    });
    EXPECT_LT(moved, 1.02) << name;
    RecordProperty(name, fmt::format("{} {}", turned, moved));
  }
}

TEST(Highlights, OfGpuAndReferenceAreTheSame) {
  REQUIRE_DEVICE();
  for (const char* name : {"tank", "shadow_sausage"}) {
    const auto setup = make_setup(name, std::string(name) == "tank" ? tank_crop : dish_crop, 16);
    GpuBackend gpu(gpu::Device::open("auto", true), setup->world, setup->settings);
    reference::ReferenceBackend cpu(setup->world, setup->settings);
    for (const std::uint32_t pass : {0U, 1U}) {
      const std::vector<glm::dvec3> a = highlights(gpu, pass), b = highlights(cpu, pass);
      double square = 0, reference_square = 0;
      for (std::size_t i = 0; i < b.size(); ++i) {
        square += glm::dot(a[i] - b[i], a[i] - b[i]);
        reference_square += glm::dot(b[i], b[i]);
      }
      ASSERT_GT(reference_square, 0);
      EXPECT_LT(std::sqrt(square / reference_square), 1e-3) << name;
    }
  }
}

TEST(Highlights, AreNotLookedForWhereThereAreNone) {
  const auto asked = [](const char* name, std::uint32_t samples) {
    RenderOptions options = options_for(samples);
    options.meniscus = MeniscusModel::paper;
    return test::make_setup(name, options)->settings.highlights;
  };
  EXPECT_EQ(asked("flat_water", 16), shared::HIGHLIGHTS_NONE);
  EXPECT_EQ(asked("tank", 0), shared::HIGHLIGHTS_NONE);
  EXPECT_EQ(asked("tank", 16), shared::HIGHLIGHTS_ALL);
  EXPECT_EQ(asked("shadow_sausage", 16), shared::HIGHLIGHTS_NO_AREAS);
}

}  // namespace
}  // namespace meniscal

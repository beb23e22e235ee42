// Light that diffuse surfaces throw on each other, against closed forms and against path tracing.
#include <glm/gtc/constants.hpp>

#include "tests/support/scene_setup.h"

namespace meniscal {
namespace {

Image render(Backend& backend, const RenderSettings& settings, std::uint32_t passes) {
  Film film(settings.crop, {"irradiance"}, {});
  render_passes(backend, {0, passes}, film, [](const Tallies&) { return true; });
  return film.image(settings.width, settings.height);
}

// Over all pixels and channels.
double mean(const Layer& layer) {
  double sum = 0;
  for (const float v : layer.pixels) sum += double(v);
  return sum / double(layer.pixels.size());
}
double mean_radiance(Backend& backend, const RenderSettings& settings, std::uint32_t passes) {
  return mean(render(backend, settings, passes).layers[0]);
}

// In a closed room that emits half of what it would as a black body, and reflects the other half, radiance is that of
// the black body everywhere: 1.
class Furnace : public testing::TestWithParam<Quality> {};

TEST_P(Furnace, IsBlack) {
  REQUIRE_DEVICE();
  RenderOptions options = test::small_options(100000, 24, 18);
  options.quality = GetParam();
  options.samples = 4;
  options.diffuse_bounces = 40;
  const auto setup = test::make_setup("tank", options, [](Scene& scene) {
    std::erase_if(scene.objects, [](const Object& o) { return o.name != "tank"; });
    for (Material& m : scene.materials) m.base_color = m.emission = glm::dvec3(0.5);
  });
  GpuBackend gpu(gpu::Device::open("auto"), setup->world, setup->settings);
  const Image image = render(gpu, setup->settings, 64);  // 2 passes are off by 1.2 % of their mean
  const double radiance = mean(image.layers[0]), irradiance = mean(*image.find("irradiance")) / glm::pi<double>();
  std::printf("radiance %.5f, irradiance / pi %.5f\n", radiance, irradiance);
  // Discs reach beyond the room's edges: what they lose there is the map's bias, and less when it is gathered from.
  const double bias = GetParam() == Quality::final ? 0.01 : 0.03;
  EXPECT_NEAR(radiance, 1, bias);
  EXPECT_NEAR(irradiance, 1, 2 * bias);
}
INSTANTIATE_TEST_SUITE_P(Qualities, Furnace, testing::Values(Quality::draft, Quality::final),
                         [](const auto& tested) { return tested.param == Quality::draft ? "draft" : "final"; });

// Water, menisci and white walls; metals, plastics and frosted glass: every kind of path carries light. By photons from
// the targets, by photons from the lights alone, and by no photons at all: one answer.
struct Answer {
  const char* scene;
  std::uint32_t diffuse_bounces;  // lobes that are followed go one further: there, enough that it counts for nothing
};
class Interreflection : public testing::TestWithParam<Answer> {};

TEST_P(Interreflection, OfPhotonsAndPaths) {
  REQUIRE_DEVICE();
  RenderOptions options = test::small_options(200000, 48, 36);
  options.diffuse_bounces = GetParam().diffuse_bounces;
  const auto radiance_by = [&](Integrator integrator, Quality quality, std::uint32_t samples, std::uint32_t passes) {
    options.integrator = integrator;
    options.quality = quality;
    options.samples = samples;
    const auto setup = test::make_setup(GetParam().scene, options);
    if (integrator == Integrator::path) {
      reference::ReferenceBackend cpu(setup->world, setup->settings);
      return mean_radiance(cpu, setup->settings, passes);
    }
    GpuBackend gpu(gpu::Device::open("auto"), setup->world, setup->settings);
    return mean_radiance(gpu, setup->settings, passes);
  };
  const double path = radiance_by(Integrator::path, Quality::final, 60, 1);
  const double gathered = radiance_by(Integrator::targeted, Quality::final, 4, 4);
  const double shown = radiance_by(Integrator::targeted, Quality::draft, 4, 4);
  const double ordinary = radiance_by(Integrator::ordinary, Quality::draft, 4, 8);
  std::printf("radiance: path %.5f, gathered %.5f, map %.5f, ordinary %.5f\n", path, gathered, shown, ordinary);
  EXPECT_NEAR(gathered, path, 0.01 * path);
  EXPECT_NEAR(shown, path, 0.03 * path);
  EXPECT_NEAR(ordinary, path, 0.02 * path);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Interreflection, testing::Values(Answer{"tank", 2}, Answer{"materials", 8}),
                         [](const auto& tested) { return std::string(tested.param.scene); });

}  // namespace
}  // namespace meniscal

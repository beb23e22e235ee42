// Where light goes: what lights emit is absorbed, stored, cut or escapes; and no layer holds what light cannot be.
#include <cmath>
#include <filesystem>
#include <glm/gtc/constants.hpp>
#include <numeric>

#include "tests/support/scene_setup.h"

namespace meniscal {
namespace {

double landed(const Tally& t) { return std::accumulate(t.flux_landed.begin(), t.flux_landed.end(), 0.0); }

// Of all lights, by closed forms. Distant ones shine on a disc across the scene.
double emitted(const World& world) {
  constexpr double pi = glm::pi<double>();
  double sum = 0;
  for (const shared::Light& light : world.lights) {
    double measure = 4 * pi;
    if (light.type == shared::LIGHT_DIRECTIONAL) measure = pi * world.radius * world.radius;
    if (light.type == shared::LIGHT_AREA) measure = pi * double(light.area) * (light.double_sided ? 2 : 1);
    if (light.type == shared::LIGHT_SPOT) {
      // The falloff is the square of what rises over the versines from the cone's to the full one's, and 1 there.
      const double outer = double(light.cone_versine), ramp = std::min(1 / double(light.cone_scale), outer),
                   most = ramp * double(light.cone_scale);
      measure = 2 * pi * (ramp * most * most / 3 + outer - ramp);
    }
    sum += measure * mean_of(light.intensity);
  }
  return sum;
}

// No media that absorb, no mirrors, and glass without colour.
bool clear(const World& world) {
  return std::all_of(world.surfaces.begin(), world.surfaces.end(), [](const shared::Surface& s) {
    return s.specular == 0 ||
           (s.kind != shared::SPECULAR_MIRROR && s.tint == glm::vec3(1) && s.absorption == glm::vec3(0));
  });
}

void expect_balance(const test::Setup& setup, const Tallies& tallies) {
  for (const std::uint32_t map : {shared::MAP_TARGETED, shared::MAP_CAUSTIC}) {
    const Tally& t = tallies[map];
    EXPECT_NEAR(landed(t) + t.flux_escaped + t.flux_cut + t.flux_absorbed, t.flux_in, 1e-5 * t.flux_in);
    EXPECT_GE(t.flux_absorbed, -1e-5 * t.flux_in);
    if (clear(setup.world)) {
      EXPECT_LE(t.flux_absorbed, 1e-5 * t.flux_in);
    }
  }
  const Tally& t = tallies[shared::MAP_GLOBAL];
  EXPECT_NEAR(t.flux_escaped + t.flux_cut + t.flux_absorbed, t.flux_in, 1e-3 * t.flux_in);
  std::printf("global: in %.4g, off by %.2g of that\n", t.flux_in,
              (t.flux_escaped + t.flux_cut + t.flux_absorbed) / t.flux_in - 1);
}

void expect_possible(const Image& image) {
  for (const Layer& layer : image.layers) {
    const bool directed = layer.name == "normal" || layer.name == "position";
    for (std::size_t i = 0; i < layer.pixels.size(); ++i) {
      const float v = layer.pixels[i];
      ASSERT_TRUE(std::isfinite(v) && (directed || v >= 0)) << layer.name << "[" << i << "]: " << v;
    }
  }
}

std::vector<std::string> all_scenes() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(SCENES))
    if (entry.path().extension() == ".gltf") names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

class Energy : public testing::TestWithParam<std::string> {};

TEST_P(Energy, IsKept) {
  REQUIRE_DEVICE();
  for (const Integrator integrator : {Integrator::targeted, Integrator::ordinary}) {
    const bool targeted = integrator == Integrator::targeted;
    SCOPED_TRACE(targeted ? "targeted" : "ordinary");
    RenderOptions options = test::small_options(40000, 24, 18);
    options.integrator = integrator;
    options.quality = targeted ? Quality::final : Quality::draft;
    options.diffuse_bounces = 3;
    const auto setup = test::make_setup(GetParam(), options);
    GpuBackend gpu(gpu::Device::open("auto"), setup->world, setup->settings);
    Film film(setup->settings.crop, aov_names(), {});
    const Tallies tallies = render_passes(gpu, {0, 2}, film, [](const Tallies&) { return true; });
    expect_balance(*setup, tallies);
    expect_possible(film.image(24, 18));
    if (targeted) continue;
    double sum = 0;
    for (const std::uint32_t map : {shared::MAP_TARGETED, shared::MAP_CAUSTIC})
      sum += (tallies[map].flux_in + tallies[map].flux_dropped) / 2;
    std::printf("emitted %.5g, off by %.2g\n", emitted(setup->world), sum / emitted(setup->world) - 1);
    EXPECT_NEAR(sum, emitted(setup->world), 1e-3 * sum);
  }
}
INSTANTIATE_TEST_SUITE_P(Scenes, Energy, testing::ValuesIn(all_scenes()),
                         [](const auto& tested) { return tested.param; });

// Murky water, a mirror and coloured walls: the accounts of the GPU are those of the reference path.
TEST(Accounts, OfGpuAndReferenceAreTheSame) {
  REQUIRE_DEVICE();
  RenderOptions options = test::small_options(40000, 8, 6);
  options.quality = Quality::draft;
  options.diffuse_bounces = 3;
  const auto setup = test::make_setup("tank", options, [](Scene& scene) {
    for (Material& m : scene.materials)
      if (m.liquid)
        m.absorption = {2, 5, 11};
      else if (m.transmission == 0)
        m.base_color *= glm::dvec3(0.9, 0.6, 0.2);
  });
  GpuBackend gpu(gpu::Device::open("auto"), setup->world, setup->settings);
  reference::ReferenceBackend cpu(setup->world, setup->settings);
  const Tallies a = test::render_pass(gpu, 0).tallies, b = test::render_pass(cpu, 0).tallies;
  for (std::size_t map = 0; map < shared::MAPS; ++map) {
    SCOPED_TRACE(map);
    EXPECT_GT(b[map].flux_absorbed, 0.05 * b[map].flux_in);
    for (const auto flux :
         {&Tally::flux_in, &Tally::flux_escaped, &Tally::flux_cut, &Tally::flux_absorbed, &Tally::flux_dropped})
      EXPECT_NEAR(a[map].*flux, b[map].*flux, 1e-3 * b[map].flux_in);
  }
}

}  // namespace
}  // namespace meniscal

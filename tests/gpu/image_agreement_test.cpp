// Pictures: GPU against reference, run against run, seed against seed.
#include <cmath>
#include <cstring>

#include "tests/support/skies.h"
#include "tests/support/textured_scene.h"

namespace meniscal {
namespace {

std::vector<shared::PixelSample> samples_of(Backend& backend, std::uint32_t pass) {
  return test::render_pass(backend, pass).samples;
}

// The samples of a pass, but for a thousandth whose paths hang on rounding.
void expect_alike(const test::Setup& setup) {
  GpuBackend gpu(gpu::Device::open("auto", true), setup.world, setup.settings);
  reference::ReferenceBackend cpu(setup.world, setup.settings);
  const test::PassResult a = test::render_pass(gpu, 2), b = test::render_pass(cpu, 2);
  const std::size_t count = a.samples.size();
  ASSERT_EQ(count, b.samples.size());
  ASSERT_EQ(a.gloss.size(), b.gloss.size());
  std::size_t flipped = 0;
  double difference = 0, square = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (a.samples[i].triangle != b.samples[i].triangle) {
      ++flipped;
      continue;
    }
    const glm::dvec3 d = test::radiance(a, i) - test::radiance(b, i), r = test::radiance(b, i);
    difference += glm::dot(d, d);
    square += glm::dot(r, r);
  }
  EXPECT_LE(flipped, count / 1000);
  EXPECT_GT(square, 0);
  EXPECT_LT(std::sqrt(difference / square), 1e-3);
}

std::unique_ptr<test::Setup> make_named(const std::string& name) {
  const test::NamedLight named = test::named_light(name);
  return test::make_setup(named.file, test::small_options(40000, 80, 60), named.edit);
}

class ImageAgreement : public testing::TestWithParam<const char*> {};

TEST_P(ImageAgreement, GpuAndReferenceGiveTheSamePicture) {
  REQUIRE_DEVICE();
  const auto setup = make_named(GetParam());
  setup->settings.split = 2;
  setup->settings.samples = 2;
  expect_alike(*setup);
}

// Interreflection too, as the global map has it and gathered from it, and by outer faces of every kind.
class Interreflection : public testing::TestWithParam<const char*> {};

TEST_P(Interreflection, OfGpuAndReferenceIsTheSame) {
  REQUIRE_DEVICE();
  for (const Quality quality : {Quality::draft, Quality::final}) {
    RenderOptions options = test::small_options(40000, 80, 60);
    options.diffuse_bounces = 3;
    options.quality = quality;
    const auto setup = test::make_setup(GetParam(), options);
    expect_alike(*setup);
  }
}
INSTANTIATE_TEST_SUITE_P(Scenes, Interreflection, testing::Values("tank", "materials"),
                         [](const auto& tested) { return std::string(tested.param); });

// Textures of every kind, of floor, glass, mirror and lamp.
TEST(Textures, OfGpuAndReferenceAreTheSame) {
  REQUIRE_DEVICE();
  RenderOptions options = test::small_options(40000, 80, 60);
  options.diffuse_bounces = 3;
  const auto setup = test::make_setup(test::make_gallery(), options);
  setup->settings.split = 2;
  setup->settings.samples = 2;
  expect_alike(*setup);
}

TEST(Textures, FromStorageBuffersAreTheSameBits) {
  REQUIRE_DEVICE();
  const auto setup = test::make_setup(test::make_gallery(), test::small_options(40000, 80, 60));
  std::vector<shared::PixelSample> runs[2];
  for (bool texel : {false, true}) {
    GpuBackend gpu(gpu::Device::open("auto", true), setup->world, setup->settings, texel);
    runs[texel] = samples_of(gpu, 1);
  }
  EXPECT_EQ(std::memcmp(runs[0].data(), runs[1].data(), runs[0].size() * sizeof(shared::PixelSample)), 0);
}

TEST_P(ImageAgreement, SameCommandSameBits) {
  REQUIRE_DEVICE();
  const auto setup = make_named(GetParam());
  std::vector<shared::PixelSample> runs[2];
  for (auto& run : runs) {
    GpuBackend gpu(gpu::Device::open("auto"), setup->world, setup->settings);
    run = samples_of(gpu, 1);
  }
  ASSERT_EQ(runs[0].size(), runs[1].size());
  EXPECT_EQ(std::memcmp(runs[0].data(), runs[1].data(), runs[0].size() * sizeof(shared::PixelSample)), 0);
}

// Without texel buffers, tables come from storage buffers: the same bits.
TEST_P(ImageAgreement, StorageBuffersGiveTheSameBits) {
  REQUIRE_DEVICE();
  const auto setup = make_named(GetParam());
  std::vector<shared::PixelSample> runs[2];
  for (bool texel : {false, true}) {
    GpuBackend gpu(gpu::Device::open("auto"), setup->world, setup->settings, texel);
    runs[texel] = samples_of(gpu, 1);
  }
  EXPECT_EQ(std::memcmp(runs[0].data(), runs[1].data(), runs[0].size() * sizeof(shared::PixelSample)), 0);
}

TEST_P(ImageAgreement, ValidationLayerIsSilent) {
  REQUIRE_DEVICE();
  const gpu::Device device = gpu::Device::open("auto", true);
  ASSERT_TRUE(device.has_validation()) << "install vulkan-validationlayers";
  for (bool texel : {false, true}) {
    const auto setup = make_named(GetParam());
    GpuBackend gpu(device, setup->world, setup->settings, texel);
    test::render_pass(gpu, 0);
    test::render_pass(gpu, 1);
  }
  EXPECT_TRUE(device.validation_messages().empty()) << device.validation_messages().front();
}

INSTANTIATE_TEST_SUITE_P(Scenes, ImageAgreement,
                         testing::Values("post", "shadow_sausage", "area_light", "beaker", "shadow_sausage-sun",
                                         "beaker-day"),
                         test::name_of_test);

// Seen through water, or two panes and water, a pixel's light is the same by roulette, on average, and by split paths,
// but for the noise.
TEST(Split, GivesTheLightOfRouletteWithLessNoise) {
  REQUIRE_DEVICE();
  for (const auto& [scene, splits] : {std::pair("shadow_sausage", 1u), std::pair("behind_glass", 2u)}) {
    SCOPED_TRACE(scene);
    const auto setup = test::make_setup(scene, test::small_options(100000, 80, 60));
    setup->settings.highlights = shared::HIGHLIGHTS_NONE;  // of a sun: in so large pixels a noise of their own
    double mean[3] = {}, noise[3] = {};
    constexpr std::uint32_t passes = 12;
    for (std::uint32_t split = 0; split <= splits; ++split) {
      setup->settings.split = split;
      GpuBackend gpu(gpu::Device::open("auto"), setup->world, setup->settings);
      Film film(setup->settings.crop, {}, {});
      render_passes(gpu, {1, 1 + passes}, film, [](const Tallies&) { return true; });
      const Image image = film.image(80, 60);
      for (float v : image.layers[0].pixels) mean[split] += double(v);
      noise[split] = film.error_estimate();
    }
    std::printf("%s: mean %.5g by roulette, %.5g split; noise %.3f and %.3f\n", scene, mean[0], mean[splits], noise[0],
                noise[splits]);
    EXPECT_NEAR(mean[splits], mean[0], 0.01 * mean[0]);
    EXPECT_LT(noise[splits], 0.7 * noise[splits - 1]);
  }
}

// A pass of more photons than the device holds at once, of several samples, is the same one in smaller parts.
TEST(Chunks, AddUpToThePass) {
  REQUIRE_DEVICE();
  const auto setup = test::make_setup("shadow_sausage", test::small_options(50000, 80, 60));
  setup->settings.split = 1;
  setup->settings.samples = 2;
  test::PassResult whole, parts;
  for (test::PassResult* result : {&whole, &parts}) {
    GpuBackend gpu(gpu::Device::open("auto"), setup->world, setup->settings);
    *result = test::render_pass(gpu, 1);
    setup->settings.photons_at_once = 7000;
  }
  ASSERT_EQ(whole.samples.size(), 4u * 80 * 60);
  ASSERT_EQ(parts.samples.size(), whole.samples.size());
  double found = 0;
  for (std::size_t i = 0; i < whole.samples.size(); ++i) {
    const shared::PixelSample &a = whole.samples[i], &b = parts.samples[i];
    found += double(a.targeted_count + a.caustic_count);
    EXPECT_EQ(a.targeted_count, b.targeted_count) << "pixel " << i;
    EXPECT_EQ(a.caustic_count, b.caustic_count) << "pixel " << i;
    EXPECT_NEAR(a.targeted.x, b.targeted.x, 1e-5f * a.targeted.x) << "pixel " << i;
    EXPECT_NEAR(a.caustic.x, b.caustic.x, 1e-5f * a.caustic.x) << "pixel " << i;
  }
  EXPECT_GT(found, 1e5);
  for (std::size_t map = 0; map < shared::MAPS; ++map) {
    EXPECT_EQ(whole.tallies[map].stored, parts.tallies[map].stored);
    EXPECT_NEAR(whole.tallies[map].flux_in, parts.tallies[map].flux_in, 1e-12 * whole.tallies[map].flux_in);
  }
}

// Several samples in a pass are as good as so many passes: the same mean, and edges as smooth.
TEST(Samples, SmoothEdgesAsPassesDo) {
  REQUIRE_DEVICE();
  const auto setup = test::make_setup("post", test::small_options(0, 40, 30));
  const auto depth = [&](std::uint32_t samples, std::uint32_t passes) {
    setup->settings.samples = samples;
    GpuBackend gpu(gpu::Device::open("auto"), setup->world, setup->settings);
    Film film(setup->settings.crop, {"depth"}, {});
    render_passes(gpu, {1, 1 + passes}, film, [](const Tallies&) { return true; });
    return film.image(40, 30).find("depth")->pixels;
  };
  const std::vector<float> truth = depth(16, 16), one = depth(1, 1), by_samples = depth(16, 1),
                           by_passes = depth(1, 16);
  const auto error = [&](const std::vector<float>& pixels) {
    double sum = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) sum += std::pow(double(pixels[i]) - double(truth[i]), 2);
    return std::sqrt(sum / double(truth.size()));
  };
  std::printf("depth's error: %.3g, by samples %.3g, by passes %.3g\n", error(one), error(by_samples),
              error(by_passes));
  EXPECT_LT(error(by_samples), 0.35 * error(one));
  EXPECT_LT(error(by_samples), 1.2 * error(by_passes));
}

// A radius as wide as the scene: each pixel tests more photons than one dispatch may, in several rounds.
TEST(Gather, RoundsAddUp) {
  REQUIRE_DEVICE();
  RenderOptions options = test::small_options(1200000, 5, 5);
  options.radius = 0.02;
  const auto setup = test::make_setup("post", options);
  GpuBackend gpu(gpu::Device::open("auto"), setup->world, setup->settings);
  reference::ReferenceBackend cpu(setup->world, setup->settings);
  const auto a = samples_of(gpu, 0), b = samples_of(cpu, 0);
  float most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    most = std::max(most, a[i].targeted_count);
    EXPECT_NEAR(a[i].targeted_count, b[i].targeted_count, 2) << "pixel " << i;
    EXPECT_NEAR(a[i].targeted.x, b[i].targeted.x, 1e-4f * b[i].targeted.x) << "pixel " << i;
  }
  EXPECT_GT(most, 2.0f * shared::GATHER_ROUND);
}

// The GPU with one seed against the reference with another: they differ by their own variance alone, chi^2 per pixel
// near 1. On flat water stratified starts leave so little noise that a Fresnel transmittance wrong by 1 % stands out.
class Seeds : public testing::TestWithParam<const char*> {};

TEST_P(Seeds, GpuAndReferenceDifferByTheirVariance) {
  REQUIRE_DEVICE();
  constexpr int passes = 20;
  Image images[2];
  for (int run = 0; run < 2; ++run) {
    RenderOptions options = test::small_options(150000, 32, 32);
    options.seed = 11 + run;
    options.radius = 4e-4;
    const auto setup = test::make_setup(GetParam(), options, [](Scene& scene) {
      for (Object& o : scene.objects)
        if (o.name == "water")
          for (glm::dvec3& p : o.mesh.positions) p *= glm::dvec3(8.0 / 30, 1, 8.0 / 30);
      scene.cameras[0].xmag = scene.cameras[0].ymag = 7e-3;
    });
    const std::unique_ptr<Backend> backend = test::make_backend(run == 0, setup->world, setup->settings);
    Film film(setup->settings.crop, {"variance"}, {});
    render_passes(*backend, {0, passes}, film, [](const Tallies&) { return true; });
    images[run] = film.image(32, 32);
  }
  double sum = 0, noise = 0, signal = 0;
  int count = 0;
  for (std::size_t i = 0; i < images[0].layers[0].pixels.size(); i += 3) {
    const double a = double(images[0].layers[0].pixels[i]), b = double(images[1].layers[0].pixels[i]);
    const double variance =
        double(images[0].find("variance")->pixels[i]) + double(images[1].find("variance")->pixels[i]);
    noise += variance;
    signal += b * b;
    if (variance <= 0) {
      EXPECT_EQ(a, b);
      continue;
    }
    sum += (a - b) * (a - b) / variance;
    ++count;
  }
  ASSERT_GT(count, 700);
  // Variances estimated from 20 passes each: t^2 of 38 degrees of freedom has mean 38 / 36.
  const double chi2 = sum / count * 36 / 38;
  std::printf("%s: chi^2 per pixel %.4f, noise %.3f %%\n", GetParam(), chi2, 100 * std::sqrt(noise / signal));
  EXPECT_NEAR(chi2, 1, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Seeds, testing::Values("post", "flat_water"),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace meniscal

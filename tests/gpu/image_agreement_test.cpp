// Pictures: GPU against reference, run against run, seed against seed.
#include <cmath>

#include "tests/support/scene_setup.h"

namespace meniscal {
namespace {

std::vector<shared::PixelSample> samples_of(Backend& backend, std::uint32_t pass) { return backend.render_pass(pass).samples; }

glm::dvec3 radiance(const shared::PixelSample& s) {
  return glm::dvec3(s.emitted) + glm::dvec3(s.weight) * (glm::dvec3(s.direct) + glm::dvec3(s.targeted) + glm::dvec3(s.caustic));
}

class ImageAgreement : public testing::TestWithParam<const char*> {};

TEST_P(ImageAgreement, GpuAndReferenceGiveTheSamePicture) {
  REQUIRE_DEVICE();
  const auto setup = test::make_setup(GetParam(), test::small_options(40000, 80, 60));
  GpuBackend gpu(gpu::Device::open("auto", true), setup->world, setup->settings);
  reference::ReferenceBackend cpu(setup->world, setup->settings);
  const auto a = samples_of(gpu, 2), b = samples_of(cpu, 2);
  ASSERT_EQ(a.size(), b.size());
  std::size_t flipped = 0;
  double difference = 0, square = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].triangle != b[i].triangle) {
      ++flipped;
      continue;
    }
    const glm::dvec3 d = radiance(a[i]) - radiance(b[i]), r = radiance(b[i]);
    difference += glm::dot(d, d);
    square += glm::dot(r, r);
  }
  EXPECT_LE(flipped, a.size() / 1000);
  EXPECT_GT(square, 0);
  EXPECT_LT(std::sqrt(difference / square), 1e-3);
}

TEST_P(ImageAgreement, SameCommandSameBits) {
  REQUIRE_DEVICE();
  const auto setup = test::make_setup(GetParam(), test::small_options(40000, 80, 60));
  std::vector<shared::PixelSample> runs[2];
  for (auto& run : runs) {
    GpuBackend gpu(gpu::Device::open("auto"), setup->world, setup->settings);
    run = samples_of(gpu, 1);
  }
  ASSERT_EQ(runs[0].size(), runs[1].size());
  EXPECT_EQ(std::memcmp(runs[0].data(), runs[1].data(), runs[0].size() * sizeof(shared::PixelSample)), 0);
}

// Differences between two seeds against the variance that the pictures state of themselves: chi^2 per pixel near 1.
TEST_P(ImageAgreement, SeedsDifferByTheirVariance) {
  REQUIRE_DEVICE();
  Image images[2];
  for (int run = 0; run < 2; ++run) {
    RenderOptions options = test::small_options(30000, 64, 48);
    options.seed = 11 + run;
    const auto setup = test::make_setup(GetParam(), options);
    GpuBackend gpu(gpu::Device::open("auto"), setup->world, setup->settings);
    Film film(setup->settings.crop, {"variance"}, {});
    render_passes(gpu, {0, 64}, film, [](std::uint32_t) { return true; });
    images[run] = film.image(64, 48);
  }
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < images[0].layers[0].pixels.size(); ++i) {
    const double variance = double(images[0].find("variance")->pixels[i]) + double(images[1].find("variance")->pixels[i]);
    const double d = double(images[0].layers[0].pixels[i]) - double(images[1].layers[0].pixels[i]);
    if (variance <= 0) {
      EXPECT_EQ(d, 0);
      continue;
    }
    sum += d * d / variance;
    ++count;
  }
  ASSERT_GT(count, 3000);
  // The variances are themselves estimates from 64 passes: t^2 of 126 degrees of freedom has mean 126 / 124.
  EXPECT_NEAR(sum / count * 124 / 126, 1, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Scenes, ImageAgreement, testing::Values("post", "shadow_sausage", "area_light"),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace meniscal

// The pilot: photons go where the camera sees what they give, and none of the light is lost.
#include "tests/support/scene_setup.h"
#include "tests/support/skies.h"

namespace meniscal {
namespace {

// A square part of the floor.
struct Part {
  double x, half;  // middle and half its width, m
};
constexpr Part round_post{0, 4e-3}, tiny{8e-3, 2e-5};

std::unique_ptr<test::Setup> view_of(const Part& part, const RenderOptions& options) {
  return test::make_setup("post", options, [&](Scene& scene) {
    for (Camera& c : scene.cameras) c.pose[3].x = part.x, c.xmag = c.ymag = part.half;
  });
}

// Of the photons, those that end there.
double share_in(const Part& part, Backend& backend) {
  const std::vector<PhotonEnd> ends = backend.trace_photons(0);
  const auto seen = std::count_if(ends.begin(), ends.end(), [&](const PhotonEnd& e) {
    return e.end < shared::END_FIRST && std::abs(e.position.x - part.x) < part.half &&
           std::abs(e.position.z) < part.half;
  });
  return double(seen) / double(ends.size());
}

RenderOptions options_of(Integrator integrator = Integrator::targeted) {
  RenderOptions options = test::small_options(100000, 48, 48);
  options.integrator = integrator;
  return options;
}

double mean_density(const test::PassResult& result) {
  double found = 0;
  for (const shared::PixelSample& s : result.samples) found += double(s.targeted_count + s.caustic_count);
  return found / double(result.samples.size());
}

double irradiance(const test::PassResult& result) {
  double sum = 0;
  for (const shared::PixelSample& s : result.samples) sum += mean_of(s.targeted + s.caustic);
  return sum / double(result.samples.size());
}

TEST(Pilot, SendsPhotonsWhereTheyAreSeen) {
  REQUIRE_DEVICE();
  const RenderOptions options = options_of();
  const auto setup = view_of(round_post, options);
  GpuBackend gpu(gpu::Device::open("auto"), setup->world, setup->settings);
  const double before = share_in(round_post, gpu);
  const test::PassResult wide = test::render_pass(gpu, 0);
  focus(setup->settings, options, setup->world, gpu);
  const double after = share_in(round_post, gpu);
  std::printf("seen: %.3f of the photons before, %.3f after\n", before, after);
  EXPECT_GT(after, 0.35);
  EXPECT_GT(after, 2 * before);

  const test::PassResult narrow = test::render_pass(gpu, 0);
  EXPECT_GT(mean_density(narrow), mean_density(wide) / 4) << "narrower discs, more of them";
  EXPECT_NEAR(irradiance(narrow), irradiance(wide), 0.02 * irradiance(wide));
  for (std::size_t map = 0; map < shared::MAPS; ++map) {
    const double flux = wide.tallies[map].flux_in;
    EXPECT_NEAR(narrow.tallies[map].flux_in, flux, 0.02 * flux) << "what is not seen is not lost, either";
  }
}

// So little is seen that none of the photons it looks with land there at first; by one pixel, too.
TEST(Pilot, ZoomsInOnWhatIsTiny) {
  REQUIRE_DEVICE();
  for (const int pixels : {48, 1}) {
    RenderOptions options = options_of();
    options.resolution = Resolution{pixels, pixels};
    const auto setup = view_of(tiny, options);
    GpuBackend gpu(gpu::Device::open("auto"), setup->world, setup->settings);
    const double before = share_in(tiny, gpu);
    focus(setup->settings, options, setup->world, gpu);
    const double after = share_in(tiny, gpu);
    std::printf("seen: %.3g of the photons before, %.3g after\n", before, after);
    EXPECT_LT(before, 1e-4);
    EXPECT_GT(after, 0.2);
  }
}

TEST(Pilot, WithoutAnythingSeenKeepsTheDefault) {
  REQUIRE_DEVICE();
  const RenderOptions options = options_of();
  const auto setup = test::make_setup("post", options, [](Scene& scene) {
    for (Camera& c : scene.cameras) c.pose[3] += glm::dvec4(100, 0, 0, 0);
  });
  const std::vector<shared::Beam> before = setup->settings.caustics.beams;
  GpuBackend gpu(gpu::Device::open("auto"), setup->world, setup->settings);
  focus(setup->settings, options, setup->world, gpu);
  ASSERT_EQ(setup->settings.caustics.beams.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(setup->settings.caustics.beams[i].count, before[i].count);
}

// A beaker in the open gives its light away; in a white room it comes back. The reference path finds the same.
TEST(Pilot, GivesPhotonsToTheMapThatIsNoisy) {
  REQUIRE_DEVICE();
  RenderOptions options = options_of();
  options.diffuse_bounces = 4;
  const auto budgets = [&](const char* scene, Quality quality, bool on_gpu) {
    options.quality = quality;
    const auto setup = test::make_setup(scene, options);
    const std::unique_ptr<Backend> backend = test::make_backend(on_gpu, setup->world, setup->settings);
    focus(setup->settings, options, setup->world, *backend);
    return std::array<double, 2>{double(setup->settings.caustics.count()), double(setup->settings.global.count())};
  };
  for (const Quality quality : {Quality::draft, Quality::final}) {
    const auto open = budgets("beaker", quality, true), closed = budgets("tank", quality, true);
    std::printf("caustics and global: %.0f and %.0f in the open, %.0f and %.0f in a room\n", open[0], open[1],
                closed[0], closed[1]);
    EXPECT_LT(open[1], 0.2 * open[0]);
    EXPECT_GT(closed[1], 3 * closed[0]);
  }
  const auto on_gpu = budgets("shadow_sausage", Quality::draft, true);
  const auto on_cpu = budgets("shadow_sausage", Quality::draft, false);
  EXPECT_NEAR(on_cpu[1], on_gpu[1], 150000.0 / 64) << "a step, at the most";
  EXPECT_NEAR(on_cpu[0], on_gpu[0], 150000.0 / 64);
}

// Ordinary photon mapping is noisy and blurred, but the same light: on the GPU, on the reference path, and as from
// targets.
TEST(Ordinary, GivesTheSameLight) {
  REQUIRE_DEVICE();
  RenderOptions options = options_of(Integrator::ordinary);
  options.photons = 400000;
  for (const char* scene :
       {"post", "area_light", "spot_light", "point_light", "post-sun", "post-wide_sun", "post-day"}) {
    const test::NamedLight named = test::named_light(scene);
    const auto setup = test::make_setup(named.file, options, named.edit);
    GpuBackend gpu(gpu::Device::open("auto"), setup->world, setup->settings);
    const test::PassResult ordinary = test::render_pass(gpu, 0);
    const auto targeted_setup = test::make_setup(named.file, options_of(), named.edit);
    GpuBackend targeted_gpu(gpu::Device::open("auto"), targeted_setup->world, targeted_setup->settings);
    const test::PassResult targeted = test::render_pass(targeted_gpu, 0);
    for (std::size_t map = 0; map < shared::MAPS; ++map) {
      const double flux = targeted.tallies[map].flux_in;
      const double noise = 4 * flux / std::sqrt(std::max(double(ordinary.tallies[map].visible), 1.0));
      EXPECT_NEAR(ordinary.tallies[map].flux_in, flux, 0.01 * flux + noise) << scene << " map " << map;
    }
  }
}

}  // namespace
}  // namespace meniscal

// What a render says of its own error, against the truth: the spread of seeds, and a converged reference.
#include <cmath>

#include "host/render/stopping.h"
#include "tests/support/scene_setup.h"

namespace meniscal {
namespace {

constexpr int side = 32;

// A backend of its own for a scene, a seed and so many photons a pass.
struct Renderer {
  std::unique_ptr<test::Setup> setup;
  std::unique_ptr<GpuBackend> backend;

  Renderer(const std::string& scene, std::uint32_t photons, std::uint32_t seed) {
    RenderOptions options = test::small_options(photons, side, side);
    options.seed = seed;
    setup = test::make_setup(scene, options);
    backend = std::make_unique<GpuBackend>(gpu::Device::open("auto"), setup->world, setup->settings);
    focus(setup->settings, options, setup->world, *backend);
  }
  Film film() const { return Film(setup->settings.crop, {"variance"}, {}); }
  // As many passes as `goes_on` says; the beauty.
  std::vector<float> render(
      Film& to, std::uint32_t passes, const std::function<bool()>& goes_on = [] { return true; }) {
    render_passes(*backend, {0, passes}, to, [&](const Tallies&) { return goes_on(); });
    return to.image(side, side).layers[0].pixels;
  }
};

double relative_error(const std::vector<float>& pixels, const std::vector<float>& truth) {
  double squares = 0, signal = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    squares += std::pow(double(pixels[i]) - double(truth[i]), 2);
    signal += double(truth[i]) * double(truth[i]);
  }
  return std::sqrt(squares / signal);
}

// The variance of a picture, as its passes tell, and as pictures of other seeds do.
TEST(Variance, OfPassesIsThatOfSeeds) {
  REQUIRE_DEVICE();
  constexpr int seeds = 32, passes = 16;
  Renderer renderer("flat_water", 3000, 0);
  std::vector<double> sums(3 * side * side), squares(sums.size());
  double told = 0;
  for (std::uint32_t seed = 0; seed < seeds; ++seed) {
    renderer.setup->settings.seed = seed;
    renderer.backend->configure(renderer.setup->settings);
    Film film = renderer.film();
    const std::vector<float> pixels = renderer.render(film, passes);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      sums[i] += double(pixels[i]);
      squares[i] += double(pixels[i]) * double(pixels[i]);
    }
    const Image image = film.image(side, side);
    for (const float v : image.find("variance")->pixels) told += double(v) / seeds;
  }
  double seen = 0;
  for (std::size_t i = 0; i < sums.size(); ++i) seen += (squares[i] - sums[i] * sums[i] / seeds) / (seeds - 1);
  std::printf("variance %.5g, of %d seeds %.5g: %.3f\n", told, seeds, seen, told / seen);
  EXPECT_NEAR(told, seen, 0.1 * seen);
}

struct Target {
  std::string scene;
  std::uint32_t photons;  // few: discs are wide, and their blur is what is to be found
  double error;
};
void PrintTo(const Target& t, std::ostream* out) { *out << t.scene; }

class TargetError : public testing::TestWithParam<Target> {};

TEST_P(TargetError, IsTheTrueOneAtTheEnd) {
  REQUIRE_DEVICE();
  const Target& t = GetParam();
  Renderer converged(t.scene, 150000, 99), asked(t.scene, t.photons, 5);
  Film reference = converged.film(), film = asked.film();
  const std::vector<float> truth = converged.render(reference, 60);
  Stopping stopping(
      {{0, 400}, {}, t.error}, [] { return 0.0; }, 0);
  std::optional<Stop> stop;
  const std::vector<float> pixels = asked.render(film, 400, [&] {
    stop = stopping.reached(film);
    return !stop;
  });
  const double error = relative_error(pixels, truth);
  std::printf("%s: %.3f asked for; %u passes, estimate %.4f, error %.4f\n", t.scene.c_str(), t.error, film.passes(),
              film.error_estimate(), error);
  EXPECT_EQ(stop, Stop::error);
  EXPECT_GT(error, t.error / 1.5);
  EXPECT_LT(error, t.error * 1.5);
}
INSTANTIATE_TEST_SUITE_P(Slow, TargetError,
                         testing::Values(Target{"area_light", 8000, 0.05}, Target{"three_lights", 4000, 0.06},
                                         Target{"post", 4000, 0.12}),
                         [](const auto& tested) { return tested.param.scene; });

}  // namespace
}  // namespace meniscal

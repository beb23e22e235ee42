// Limits: passes, time and estimated error, whichever comes first.
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "gtest/gtest.h"
#include "host/error.h"
#include "host/image/compare.h"
#include "host/image/exr.h"
#include "host/render/progressive.h"
#include "host/render/stopping.h"
#include "tests/unit/program.h"

namespace meniscal {
namespace {

using test::Outcome;
using test::TemporaryFolder;

constexpr Crop kCrop{0, 0, 256, 256};

// Passes that take as long as they are told, of a grey image whose pixels differ from pass to pass by +-spread.
class FakeBackend final : public Backend {
 public:
  double now = 0;
  std::vector<double> seconds{1};  // of the passes; the last ones take as long as the last of these
  float spread = 0;

  Tallies render_pass(std::uint32_t pass, const TakeSamples& take) override {
    now += seconds[std::min<std::size_t>(pass, seconds.size() - 1)];
    std::vector<shared::PixelSample> samples(kCrop.pixels());
    for (shared::PixelSample& s : samples) {
      s.emitted = glm::vec3(1 + (random_() % 2 == 0 ? spread : -spread));
    }
    take({std::move(samples), {}, {}}, {});
    return {};
  }
  std::vector<PhotonEnd> trace_photons(std::uint32_t) override { return {}; }
  std::vector<shared::PixelSample> trace_camera(std::uint32_t, const View&) override { return {}; }
  Samples light_camera(std::uint32_t, const View&, std::uint32_t) override { return {}; }
  void configure(const RenderSettings&) override {}
  Statistics statistics() const override { return {}; }

 private:
  std::mt19937 random_;
};

struct Ended {
  std::optional<Stop> stop;
  std::uint32_t passes;
  double error;
};

Ended render(FakeBackend& backend, const Limits& limits, double reserve = 0) {
  Film film(kCrop, {}, {});
  Stopping stopping(
      limits, [&] { return backend.now; }, reserve);
  std::optional<Stop> stop;
  render_passes(backend, limits.passes, film, [&](const Tallies&) {
    stopping.pass_ended();
    stop = stopping.reached(film);
    return !stop;
  });
  return {stop, film.passes(), film.error_estimate()};
}

TEST(Stopping, AfterTheLastPass) {
  FakeBackend backend;
  const Ended ended = render(backend, {{3, 8}, 100, {}});
  EXPECT_EQ(ended.passes, 5u);
  EXPECT_EQ(ended.stop, Stop::passes);
}

TEST(Stopping, BeforeAPassThatDoesNotFit) {
  FakeBackend backend;
  backend.seconds = {1};
  const Ended ended = render(backend, {{0, most_passes}, 9.5, {}});
  EXPECT_EQ(ended.stop, Stop::time);
  EXPECT_EQ(ended.passes, 9u) << "the tenth would end at 10";

  FakeBackend again;
  EXPECT_EQ(render(again, {{0, most_passes}, 9.5, {}}, 0.7).passes, 8u) << "the ninth leaves 0.5";

  FakeBackend slow;  // one picture there must be
  slow.seconds = {30};
  EXPECT_EQ(render(slow, {{0, most_passes}, 9.5, {}}).passes, 1u);
}

TEST(Stopping, GoesByTheLongestOfTheLastPasses) {
  FakeBackend slower;
  slower.seconds = {1, 1, 2};
  EXPECT_EQ(render(slower, {{0, most_passes}, 7.5, {}}).passes, 4u) << "ended at 6, the next at 8";
  FakeBackend faster;  // the first passes warm up
  faster.seconds = {4, 0.5};
  const Ended ended = render(faster, {{0, most_passes}, 20, {}});
  EXPECT_EQ(ended.passes, 1 + 16 / 0.5);
}

TEST(Stopping, AtTheTargetError) {
  FakeBackend backend;
  backend.spread = 0.4f;  // of one pass: standard error 0.4 / sqrt(n - 1) as estimated
  const Ended ended = render(backend, {{0, most_passes}, {}, 0.05});
  EXPECT_EQ(ended.stop, Stop::error);
  EXPECT_LE(ended.error, 0.05);
  EXPECT_NEAR(ended.passes, 64, 5) << "0.4 / sqrt(n) = 0.05";

  FakeBackend calm;
  EXPECT_EQ(render(calm, {{0, most_passes}, {}, 0.05}).passes, Stopping::least_passes_for_error);
  FakeBackend few;
  EXPECT_EQ(render(few, {{0, 5}, {}, 0.05}).stop, Stop::passes);
  FakeBackend hurried;
  hurried.spread = 0.4f;
  const Ended late = render(hurried, {{0, most_passes}, 10.5, 0.05});
  EXPECT_EQ(late.stop, Stop::time);
  EXPECT_EQ(late.passes, 10u);
}

TEST(Stopping, SaysHowManyPassesThereWillBe) {
  FakeBackend backend;
  backend.spread = 0.4f;
  Film film(kCrop, {}, {});
  const auto expected = [&](const Limits& limits) {
    Stopping stopping(
        limits, [&] { return backend.now; }, 0);
    std::uint32_t passes = 0;
    film = Film(kCrop, {}, {});
    render_passes(backend, {0, 8}, film, [&](const Tallies&) {
      stopping.pass_ended();
      passes = stopping.expected_passes(film);
      return true;
    });
    return passes;
  };
  EXPECT_EQ(expected({{0, 20}, {}, {}}), 20u);
  EXPECT_EQ(expected({{0, most_passes}, {}, {}}), 0u) << "without a limit";
  EXPECT_EQ(expected({{0, most_passes}, backend.now + 30.5, {}}), 30u);
  const std::uint32_t passes = expected({{0, most_passes}, {}, 0.05});
  EXPECT_NEAR(passes, 8 * std::pow(film.error_estimate() / 0.05, 2), 1);
  EXPECT_GT(passes, 8u);
}

// Of passes of a picture that sharpens from pass to pass, as footprints shrink: the error as estimated, over the true
// one.
double estimated_of_true(const PassRange& passes, double blur, double noise) {
  constexpr std::size_t pixels = 4000;
  PassSums sums(pixels, 80);
  std::uint32_t state = 7;
  for (std::uint32_t pass = passes.first; pass < passes.last; ++pass) {
    std::vector<glm::dvec3> image(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
      const double off = (i % 2 == 0 ? blur : -blur) * std::pow(pass + 1.0, -0.45);
      state = state * 1664525u + 1013904223u;
      image[i] = glm::dvec3(1 + off + ((state >> 16) % 2 == 0 ? noise : -noise) * std::pow(pass + 1.0, 0.25));
    }
    sums.add(pass, image);
  }
  double square = 0;
  for (std::size_t i = 0; i < pixels; ++i) square += std::pow(sums.mean(i).x - 1, 2);
  return sums.error_estimate() / std::sqrt(square / pixels);
}

TEST(ErrorEstimate, CountsTheBlurThatIsLeft) {
  EXPECT_NEAR(estimated_of_true({0, 16}, 0.1, 0), 1, 0.05);
  EXPECT_NEAR(estimated_of_true({0, 16}, 0.1, 0.2), 1, 0.05);
}

// Blur hardly varies over them: what their noise could hide of it is far more than there ever is.
TEST(ErrorEstimate, OfLatePassesIsTheirNoise) {
  for (const double blur : {0.0, 0.1, 0.4})
    for (const PassRange passes : {PassRange{64, 72}, PassRange{1000, 1008}, PassRange{1000, 1064}})
      EXPECT_NEAR(estimated_of_true(passes, blur, 0.2), 1, 0.1) << blur << " " << passes.first << ":" << passes.last;
}

const std::string kSmall = " --device cpu --meniscus paper --resolution 32x32 ";

nlohmann::json rendered(const TemporaryFolder& folder, const std::string& scene, const std::string& options,
                        const std::string& image) {
  const Outcome o = test::meniscal(folder, "render \"" SCENES "/" + scene + ".gltf\"" + kSmall + options + " -o \"" +
                                               folder / image + "\" --stats \"" + folder / "stats.json" + "\"");
  EXPECT_EQ(o.code, 0) << o.error;
  return nlohmann::json::parse(test::read_bytes(folder / "stats.json"));
}

TEST(Stopping, AtATargetErrorThatIsTheTrueOne) {
  const TemporaryFolder folder;
  const std::string scene = "flat_water";
  const double target = 0.03;
  const nlohmann::json stats =
      rendered(folder, scene, "--photons 4000 --seed 5 --target-error " + std::to_string(target), "some.exr");
  EXPECT_EQ(stats.at("stopped_by"), "target error");
  const int passes = stats.at("passes").get<int>();
  EXPECT_GT(passes, 8);
  rendered(folder, scene, "--photons 4000 --seed 6 --passes " + std::to_string(20 * passes), "many.exr");
  const double error =
      compare(read_exr(folder / "some.exr"), "", read_exr(folder / "many.exr"), "").front().relative_rmse;
  std::printf("%d passes, estimate %.4f, error %.4f\n", passes, stats.at("error_estimate").get<double>(), error);
  EXPECT_GT(error, target / 1.5);
  EXPECT_LT(error, target * 1.5);
}

TEST(Stopping, WhenTheTimeOfTheProcessIsUp) {
  const TemporaryFolder folder;
  const nlohmann::json stats = rendered(folder, "flat_water", "--photons 1000 --time 2", "some.exr");
  EXPECT_EQ(stats.at("stopped_by"), "time");
  const double seconds = stats.at("seconds").at("total").get<double>();
  EXPECT_GT(seconds, 1.7);
  EXPECT_LT(seconds, 2.1) << "5 % more than asked for";
}

TEST(StoppingSlow, EndsWithinATwentiethOfTheTime) {
  const TemporaryFolder folder;
  const nlohmann::json stats = rendered(folder, "shadow_sausage", "--photons 5000 --time 12", "some.exr");
  EXPECT_EQ(stats.at("stopped_by"), "time");
  EXPECT_NEAR(stats.at("seconds").at("total").get<double>(), 12, 0.6);
}

}  // namespace
}  // namespace meniscal

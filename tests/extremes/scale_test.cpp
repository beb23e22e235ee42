// Scenes of any size and anywhere, pictures of any size, discs from a millionth of the scene to all of it.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/extremes/extremes.h"

namespace meniscal::extremes {
namespace {

RenderOptions options_of(MeniscusModel model, std::uint32_t photons = 20000) {
  RenderOptions options = test::small_options(photons, 48, 36);
  options.meniscus = model;
  return options;
}

Both with_other_seed(const std::string& name, RenderOptions options) {
  options.seed = 7;
  return render_both(*test::make_setup(name, options));
}

// But photons may hit elsewhere, by what a solver rounds: two pictures differ as those of two seeds do.
void expect_same(const Both& a, const Both& b, const Both& other_seed, const std::string& what) {
  std::printf("%s: %.3g, by another seed %.3g\n", what.c_str(), relative_rms(a.cpu, b.cpu),
              relative_rms(other_seed.cpu, b.cpu));
  for (const auto side : {&Both::cpu, &Both::gpu})
    EXPECT_LT(relative_rms(a.*side, b.*side), 1e-3 + 1.2 * relative_rms(other_seed.*side, b.*side)) << what;
}

class SceneScale : public testing::TestWithParam<std::tuple<const char*, MeniscusModel>> {};

TEST_P(SceneScale, ChangesNothing) {
  REQUIRE_DEVICE();
  const auto& [name, model] = GetParam();
  const RenderOptions options = options_of(model);
  const Both usual = render_both(*test::make_setup(name, options));
  const Both other_seed = with_other_seed(name, options);
  for (const double scale : {1e-6, 1e-3, 1e3, 1e6})
    expect_same(render_both(*test::make_setup(name, options, [&](Scene& scene) { scale_by(scene, scale); })), usual,
                other_seed, fmt::format("times {}", scale));
}
INSTANTIATE_TEST_SUITE_P(Scenes, SceneScale,
                         testing::Combine(testing::Values("shadow_sausage", "tank"),
                                          testing::Values(MeniscusModel::paper, MeniscusModel::exact)),
                         [](const auto& tested) {
                           return fmt::format("{}_{}", std::get<0>(tested.param), name_of(std::get<1>(tested.param)));
                         });

TEST(ScenePlace, TenKilometresAwayIsTheSame) {
  REQUIRE_DEVICE();
  const std::string scenes = SCENES;
  nlohmann::json file = nlohmann::json::parse(std::ifstream(scenes + "/shadow_sausage.gltf"));
  nlohmann::json far;
  far["translation"] = {10000, 30, -7000};
  far["children"] = file["scenes"][0]["nodes"];
  file["nodes"].push_back(far);
  file["scenes"][0]["nodes"] = {file["nodes"].size() - 1};
  const auto path = std::filesystem::temp_directory_path() / ("far_" + std::to_string(::getpid()) + ".gltf");
  std::ofstream(path) << file;
  const RenderOptions options = options_of(MeniscusModel::exact);
  const Both usual = render_both(*test::make_setup("shadow_sausage", options));
  const Both other =
      render_both(*test::make_setup("shadow_sausage", options, [&](Scene& scene) { scene = load_gltf(path); }));
  std::filesystem::remove(path);
  expect_same(other, usual, with_other_seed("shadow_sausage", options), "far away");
}

class DiscRadius : public testing::TestWithParam<double> {};

TEST_P(DiscRadius, OfTheSceneGivesTheSamePictureByBothPaths) {
  REQUIRE_DEVICE();
  RenderOptions options = options_of(MeniscusModel::paper, 2000);
  const auto radius = test::make_setup("post", options)->world.radius;
  options.radius = GetParam() * radius;
  const Both both = render_both(*test::make_setup("post", options));
  EXPECT_EQ(both.cpu.size(), 48u * 36u);
}
INSTANTIATE_TEST_SUITE_P(Radii, DiscRadius, testing::Values(1e-6, 1e-3, 0.1, 1.0));

TEST(Photons, MayBeOne) {
  REQUIRE_DEVICE();
  render_both(*test::make_setup("tank", options_of(MeniscusModel::paper, 1)));
}

TEST(Picture, MayBeOnePixelOrAPartOfSixteenThousandSquared) {
  REQUIRE_DEVICE();
  RenderOptions options = options_of(MeniscusModel::paper);
  options.resolution = Resolution{1, 1};
  EXPECT_EQ(render_both(*test::make_setup("tank", options)).cpu.size(), 1u);
  options.resolution = Resolution{16384, 16384};
  for (const std::uint32_t corner : {0u, 9000u, 16384u - 24}) {
    options.crop = Crop{corner, corner, corner + 24, corner + 24};
    EXPECT_EQ(render_both(*test::make_setup("tank", options)).cpu.size(), 24u * 24u);
  }
}

}  // namespace
}  // namespace meniscal::extremes

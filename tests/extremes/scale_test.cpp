// Scenes of any size and anywhere, pictures of any size, discs from a millionth of the scene to all of it.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "tests/extremes/extremes.h"

namespace meniscal::extremes {
namespace {

RenderOptions options_of(MeniscusModel model, std::uint32_t photons = 20000) {
  RenderOptions options = test::small_options(photons, 48, 36);
  options.meniscus = model;
  return options;
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

struct Disc {
  double part;  // of the scene, its radius
  std::uint32_t kernel;
};
void PrintTo(const Disc& d, std::ostream* out) { *out << d.part << "_" << kernel_names[d.kernel]; }
class DiscRadius : public testing::TestWithParam<Disc> {};

// At a squared distance of so many radii; all with a second moment of 1/4.
double density(std::uint32_t kernel, double squared) {
  constexpr double pi = std::numbers::pi;
  if (kernel == shared::KERNEL_BIWEIGHT) return squared < 1 ? 3 / pi * (1 - squared) * (1 - squared) : 0;
  if (kernel == shared::KERNEL_EPANECHNIKOV) return squared < 0.75 ? 2 / (0.75 * pi) * (1 - squared / 0.75) : 0;
  return squared < 0.5 ? 2 / pi : 0;
}

// What the floor gets is the sum over the photons on it, here over all of them.
TEST_P(DiscRadius, OfTheSceneSumsThePhotonsInADisc) {
  REQUIRE_DEVICE();
  const auto [part, kernel] = GetParam();
  RenderOptions options = options_of(MeniscusModel::paper, 2000);
  const double radius = part * test::make_setup("post", options)->world.radius;
  options.radius = radius, options.kernel = kernel;
  const auto setup = test::make_setup("post", options);
  const Both both = render_both(*setup);
  reference::ReferenceBackend backend(setup->world, setup->settings);
  const std::vector<PhotonEnd> photons = backend.trace_photons(0);
  constexpr double albedo = 0.5, floor = -0.05;
  const auto is_on_floor = [&](const glm::dvec3& p) { return std::abs(p.y - floor) < 1e-6; };
  const glm::dvec3 origin = setup->scene.origin;
  Picture expected(both.cpu.size(), glm::dvec3(0)), cpu = both.cpu, gpu = both.gpu;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (!is_on_floor(both.positions[i])) {
      cpu[i] = gpu[i] = glm::dvec3(0);
      continue;
    }
    for (const PhotonEnd& p : photons) {
      if (p.end >= shared::END_FIRST || !is_on_floor(p.position + origin)) continue;
      const glm::dvec3 offset = (p.position + origin - both.positions[i]) / radius;
      expected[i] += albedo / std::numbers::pi * density(kernel, glm::dot(offset, offset)) / (radius * radius) * p.flux;
    }
  }
  if (part >= 1e-3) {
    EXPECT_GT(mean(expected), 0);
  }
  for (const Picture* picture : {&cpu, &gpu})
    EXPECT_LT(*picture == expected ? 0 : relative_rms(*picture, expected, 0.01), 1e-3);
}
INSTANTIATE_TEST_SUITE_P(Radii, DiscRadius,
                         testing::Values(Disc{1e-6, shared::KERNEL_BIWEIGHT}, Disc{1e-3, shared::KERNEL_BIWEIGHT},
                                         Disc{0.1, shared::KERNEL_BIWEIGHT}, Disc{1, shared::KERNEL_BIWEIGHT},
                                         Disc{0.1, shared::KERNEL_EPANECHNIKOV}, Disc{0.1, shared::KERNEL_UNIFORM}));

TEST(Photons, MayBeOne) {
  REQUIRE_DEVICE();
  render_both(*test::make_setup("tank", options_of(MeniscusModel::paper, 1)));
}

TEST(Picture, OfOnePixelIsTheMeanOfMany) {
  REQUIRE_DEVICE();
  RenderOptions options = test::small_options(100000, 48, 48);
  const Both many = render_both(*test::make_setup("post", options));
  options.resolution = Resolution{1, 1}, options.samples = 1024;
  const Both one = render_both(*test::make_setup("post", options));
  ASSERT_EQ(one.cpu.size(), 1u);
  std::printf("%.4g and %.4g, many %.4g\n", mean(one.cpu), mean(one.gpu), mean(many.cpu));
  for (const Picture* picture : {&one.cpu, &one.gpu}) EXPECT_NEAR(mean(*picture) / mean(many.cpu), 1, 0.05);
}

}  // namespace
}  // namespace meniscal::extremes

// The GPU's grid and gather against plain C++: the same photons, pixels and irradiance.
#include "tests/support/gpu_map.h"
#include "tests/support/scalar_gather.h"
#include "tests/support/scene_setup.h"

namespace meniscal {
namespace {

class Gather : public testing::TestWithParam<std::pair<std::uint32_t, std::uint32_t>> {};  // image's width, cells

TEST_P(Gather, IsThePlainSum) {
  REQUIRE_DEVICE();
  const auto [width, cells] = GetParam();
  const auto setup = test::make_setup("post", test::small_options(100000, static_cast<int>(width), 45));
  const gpu::Device device = gpu::Device::open("auto", true);
  test::GpuMap map(device, setup->world, setup->settings);
  map.grid.mask = cells - 1;
  map.prepare();
  for (std::uint32_t first = 0; first < map.count; map.gather_from_grid()) first += map.build_grid(first);
  const auto discs = map.photons.discs.download<shared::PhotonDisc>();
  const test::ScalarGrid scalar(discs, map.grid);
  const auto samples = map.samples();
  ASSERT_EQ(samples.size(), setup->settings.crop.pixels());
  float brightest = 0;
  for (const auto& s : samples) brightest = std::max(brightest, s.targeted.y + s.caustic.y);
  ASSERT_GT(brightest, 0);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto& s = samples[i];
    const glm::vec3 expected = s.triangle < shared::END_FIRST ? scalar.irradiance(s.position, s.normal) : glm::vec3(0);
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(s.targeted[c] + s.caustic[c], expected[c], 1e-5f * brightest) << "pixel " << i;
  }
  EXPECT_TRUE(device.validation_messages().empty());
}

// Rows that are and are not whole blocks of pixels; so few cells that neighbours share keys.
INSTANTIATE_TEST_SUITE_P(Widths, Gather,
                         testing::Values(std::pair{64u, 1u << 14}, std::pair{61u, 16u}, std::pair{3u, 1u << 14}),
                         [](const auto& tested) { return std::to_string(tested.param.first); });

}  // namespace
}  // namespace meniscal

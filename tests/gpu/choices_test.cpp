// What is chosen for a device: shown as it is used, and of no consequence for the picture.
#include <array>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>

#include "host/passes/batch.h"
#include "host/passes/fetch_probe.h"
#include "host/passes/scene_tables.h"
#include "tests/support/scene_setup.h"

namespace meniscal {
namespace {

std::string output_of(const std::string& command) {
  std::FILE* pipe = popen(command.c_str(), "r");
  std::string text;
  std::array<char, 4096> part;
  while (const std::size_t n = std::fread(part.data(), 1, part.size(), pipe)) text.append(part.data(), n);
  EXPECT_EQ(pclose(pipe), 0);
  return text;
}

TEST(Choices, AreShownAsTheyAreUsed) {
  REQUIRE_DEVICE();
  const auto shown = nlohmann::json::parse(output_of("\"" MENISCAL_PROGRAM "\" devices --json")).at("devices");
  ASSERT_EQ(shown.size(), gpu::list_devices().size());
  const auto setup = test::make_setup("flat_water", test::small_options(1000, 8, 8));  // fits any texel buffer
  for (const auto& entry : shown) {
    const gpu::Device device = gpu::Device::open(std::to_string(entry.at("index").get<int>()));
    const auto& choices = entry.at("choices");
    const std::size_t texels = choices.at("texel_elements");
    EXPECT_TRUE(passes::SceneTables(device, setup->world, texels, true).texel);
    EXPECT_FALSE(passes::SceneTables(device, setup->world, texels + 1, true).texel);

    gpu::Commands commands(device);
    std::vector<std::uint32_t> batches;
    passes::Batch().run(commands, 1u << 24, [&](std::uint32_t, std::uint32_t count) { batches.push_back(count); });
    EXPECT_EQ(batches.front(), choices.at("first_batch"));
    EXPECT_EQ(*std::max_element(batches.begin(), batches.end()), choices.at("largest_batch"));  // nothing to run: fast
    EXPECT_EQ(passes::groups_of_64(1000), (1000 + choices.at("workgroup").get<int>() - 1) / 64);
  }
}

TEST(Choices, DoNotChangeThePicture) {
  REQUIRE_DEVICE();
  const auto setup = test::make_setup("shadow_sausage", test::small_options(40000, 80, 60));
  std::vector<shared::PixelSample> expected;
  const gpu::Choices usual = gpu::Device::open("auto").choices();
  for (const gpu::Choices& choices :
       {usual, gpu::Choices{0, 1e-9, 3000, 3000}, gpu::Choices{usual.texel_elements, 1e9, 100, 1u << 22}}) {
    gpu::Device device = gpu::Device::open("auto");
    device.set_choices(choices);
    GpuBackend backend(device, setup->world, setup->settings);
    const auto samples = test::render_pass(backend, 1).samples;
    if (expected.empty()) expected = samples;
    ASSERT_EQ(samples.size(), expected.size());
    EXPECT_EQ(std::memcmp(samples.data(), expected.data(), samples.size() * sizeof(samples[0])), 0);
  }
}

TEST(Choices, FollowTheMeasurement) {
  const gpu::DeviceInfo info{0, "a GPU", "discrete", "a driver", 0};
  gpu::Limits limits{};
  limits.max_texel_elements = 65536;
  EXPECT_EQ(gpu::choose(info, limits).texel_elements, 65536u);
  EXPECT_EQ(gpu::choose(info, limits, {1.0, 1.0}).texel_elements, 65536u);
  EXPECT_EQ(gpu::choose(info, limits, {1.0, 0.5}).texel_elements, 0u);
  EXPECT_FALSE(gpu::choose(info, limits, {1.0, 0.5}).reads_texels(1));
}

TEST(FetchProbe, ReadsTheSameBothWays) {
  REQUIRE_DEVICE();
  const passes::FetchProbe probe = passes::probe_fetch(gpu::Device::open("auto", true));
  EXPECT_GT(probe.seconds.texel, 0);
  EXPECT_GT(probe.seconds.storage, 0);
  EXPECT_EQ(probe.texel, probe.storage);
  // The read by the shader's first invocation, said again.
  std::uint32_t at = 0, sum = 0;
  for (int step = 0; step < 64; ++step) {
    const std::uint32_t element = at & 0xFFFFu;
    const auto word = [&](std::uint32_t k) { return (4 * element + k) * 2654435761u; };
    sum += word(0) ^ word(3);
    at = (at * 1664525u + word(1)) >> 3;
  }
  EXPECT_EQ(probe.texel.at(0), sum);
}

}  // namespace
}  // namespace meniscal

// The GPU's hash grid against the standard library's stable sort.
#include <algorithm>
#include <numeric>
#include <random>

#include "host/passes/cells.h"
#include "tests/support/scene_setup.h"

namespace meniscal {
namespace {

constexpr std::uint32_t cell_count = 1u << 11;

// Few cells hold most photons, and some photons are not stored.
std::vector<std::uint32_t> random_keys(std::uint32_t count) {
  std::mt19937 random(count);
  std::vector<std::uint32_t> keys(count);
  for (std::uint32_t& k : keys) {
    const auto cell = static_cast<std::uint32_t>(random() % 3 == 0 ? random() : random() % 7) % cell_count;
    k = random() % 5 == 0 ? shared::NO_CELL : cell;
  }
  return keys;
}

// Each told from the others by its numbers.
shared::PhotonEnd make_end(std::uint32_t i) {
  const auto x = static_cast<float>(i);
  return {glm::vec3(x, x + 0.25f, x + 0.5f), i, glm::vec3(-x, 1, 2 * x), x};
}
shared::PhotonDisc make_disc(std::uint32_t i) {
  const auto x = static_cast<float>(i);
  return {glm::vec3(3 * x, 1, x), 0, glm::vec3(x, 5 * x, 2), 0};
}
auto numbers(const shared::GatheredPhoton& p) {
  return std::tuple(p.position.x, p.position.y, p.position.z, p.flux_r, p.alpha.x, p.alpha.y, p.alpha.z, p.flux_g,
                    p.beta.x, p.beta.y, p.beta.z, p.flux_b);
}

// (photons, digits, by texel buffers)
class Cells : public testing::TestWithParam<std::tuple<std::uint32_t, std::uint32_t, bool>> {};

TEST_P(Cells, HoldTheirPhotonsInOrder) {
  REQUIRE_DEVICE();
  const auto [count, digits, texel] = GetParam();
  const std::vector<std::uint32_t> keys = random_keys(count);
  std::vector<std::uint32_t> expected(count);
  std::iota(expected.begin(), expected.end(), 0u);
  std::erase_if(expected, [&](auto i) { return keys[i] == shared::NO_CELL; });
  std::stable_sort(expected.begin(), expected.end(), [&](auto a, auto b) { return keys[a] < keys[b]; });

  const gpu::Device device = gpu::Device::open("auto", true);
  passes::PhotonBuffers unsorted(device, count);
  std::vector<shared::PhotonEnd> ends;
  std::vector<shared::PhotonDisc> discs;
  for (std::uint32_t i = 0; i < count; ++i) {
    ends.push_back(make_end(i));
    discs.push_back(make_disc(i));
  }
  unsorted.keys.upload(keys);
  unsorted.ends.upload(ends);
  unsorted.discs.upload(discs);
  passes::CellsPass grid(device, unsorted, count, cell_count, texel);
  gpu::Commands commands(device);
  for (int twice = 0; twice < 2; ++twice) grid.record(commands, count, digits);  // the second finds a used table
  commands.submit_and_wait();

  const auto photons = grid.photons.download<shared::GatheredPhoton>(0, expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto [end, disc] = std::pair(make_end(expected[i]), make_disc(expected[i]));
    const shared::GatheredPhoton wanted{end.position, end.flux.x, disc.alpha, end.flux.y, disc.beta, end.flux.z};
    ASSERT_EQ(numbers(photons[i]), numbers(wanted)) << "place " << i;
  }
  const auto cells = grid.cells.download<glm::uvec2>();
  for (std::uint32_t key = 0; key < cell_count; ++key) {
    const auto [first, last] = std::ranges::equal_range(expected, key, {}, [&](auto i) { return keys[i]; });
    const glm::uvec2 wanted(first - expected.begin(), last - expected.begin());
    if (first == last)
      ASSERT_EQ(cells[key].x, cells[key].y) << "cell " << key;
    else
      ASSERT_EQ(cells[key], wanted) << "cell " << key;
  }
  EXPECT_TRUE(device.validation_messages().empty());
}

INSTANTIATE_TEST_SUITE_P(Sizes, Cells,
                         testing::Values(std::tuple{1u, 2u, true}, std::tuple{255u, 2u, false},
                                         std::tuple{257u, 3u, true}, std::tuple{100003u, 3u, false},
                                         std::tuple{1000000u, 4u, true}),
                         [](const auto& tested) { return std::to_string(std::get<0>(tested.param)); });

}  // namespace
}  // namespace meniscal

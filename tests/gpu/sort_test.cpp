// The GPU's radix sort against the standard library's stable sort.
#include <algorithm>
#include <numeric>
#include <random>

#include "host/passes/sort.h"
#include "tests/support/scene_setup.h"

namespace meniscal {
namespace {

class Sort : public testing::TestWithParam<std::pair<std::uint32_t, std::uint32_t>> {};  // (elements, digits)

TEST_P(Sort, IsTheStableSort) {
  REQUIRE_DEVICE();
  const auto [count, digits] = GetParam();
  std::mt19937 random(count);
  std::vector<std::uint32_t> keys(count), expected(count);
  const std::uint32_t mask = (1u << (digits * shared::SORT_BITS)) - 1;
  // Few cells hold most photons, and some are not stored.
  for (std::uint32_t& k : keys) {
    const auto cell = static_cast<std::uint32_t>(random() % 3 == 0 ? random() : random() % 7) & (mask >> 1);
    k = random() % 5 == 0 ? shared::NO_CELL & mask : cell;
  }
  std::iota(expected.begin(), expected.end(), 0u);
  std::stable_sort(expected.begin(), expected.end(), [&](auto a, auto b) { return keys[a] < keys[b]; });

  const gpu::Device device = gpu::Device::open("auto", true);
  gpu::Buffer key_buffer(device, "keys", count * 4);
  key_buffer.upload(keys);
  passes::SortPass sort(device, key_buffer, count);
  gpu::Commands commands(device);
  sort.record(commands, count, digits);
  commands.submit_and_wait();
  EXPECT_EQ(sort.sorted(digits).values->download<std::uint32_t>(0, count), expected);
  std::vector<std::uint32_t> sorted_keys;
  for (std::uint32_t i : expected) sorted_keys.push_back(keys[i]);
  EXPECT_EQ(sort.sorted(digits).keys->download<std::uint32_t>(0, count), sorted_keys);
  EXPECT_TRUE(device.validation_messages().empty());
}

INSTANTIATE_TEST_SUITE_P(Sizes, Sort,
                         testing::Values(std::pair{1u, 2u}, std::pair{255u, 2u}, std::pair{257u, 3u},
                                         std::pair{100003u, 3u}, std::pair{1000000u, 3u}),
                         [](const auto& tested) { return std::to_string(tested.param.first); });

}  // namespace
}  // namespace meniscal

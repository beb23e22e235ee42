// The GPU's hash grid against the standard library's stable sort, and against points of the discs that it holds.
#include <algorithm>
#include <bit>
#include <numeric>
#include <random>

#include "host/passes/cells.h"
#include "shaders/shared/geometry.h"
#include "tests/support/scene_setup.h"

namespace meniscal {
namespace {

constexpr float narrowest = 1e-4f;
constexpr std::uint32_t levels = 6;

float uniform(std::mt19937& random, float low, float high) {
  return std::uniform_real_distribution<float>(low, high)(random);
}

// Discs any way round, of half-widths up to 30 times the narrowest; every fifth photon is not stored. Half of them
// crowd in one place.
std::vector<shared::PhotonDisc> random_discs(std::uint32_t count) {
  std::mt19937 random(count);
  std::vector<shared::PhotonDisc> discs(count);
  for (shared::PhotonDisc& d : discs) {
    const float side = random() % 2 == 0 ? 0.03f : 0.001f;
    for (int k = 0; k < 3; ++k) d.position[k] = uniform(random, -side, side);
    if (random() % 5 == 0) continue;
    const float z = uniform(random, -1, 1), a = uniform(random, 0, 6.2831f), r = std::sqrt(1 - z * z);
    const glm::vec3 along(r * std::cos(a), r * std::sin(a), z);
    const glm::vec3 other =
        glm::normalize(glm::cross(along, std::abs(z) < 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0)));
    const float turn = uniform(random, 0, 6.2831f);
    const glm::vec3 across = std::cos(turn) * other + std::sin(turn) * glm::cross(along, other);
    const float wide = narrowest * std::exp(uniform(random, 0, 3.4f));
    d.alpha = along / wide;
    d.beta = across / std::max(narrowest, wide * uniform(random, 0, 1));
  }
  return discs;
}

passes::Grid make_grid(std::uint32_t mask) {
  const auto bits = static_cast<std::uint32_t>(std::bit_width(levels * (mask + 1) - 1));
  return {{narrowest, 31 * narrowest, 1}, levels, mask, (bits + shared::SORT_BITS - 1) / shared::SORT_BITS};
}

// (key, photon) of every cell that the discs may reach into, in order of photons.
std::vector<std::pair<std::uint32_t, std::uint32_t>> entries_of(const std::vector<shared::PhotonDisc>& discs,
                                                                std::uint32_t mask) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> entries;
  for (std::uint32_t i = 0; i < discs.size(); ++i) {
    const auto& [position, red, alpha, green, beta, blue] = discs[i];
    if (alpha == glm::vec3(0)) continue;
    const std::uint32_t level = shared::disc_level(alpha, beta, narrowest, levels);
    const float size = shared::level_cell_size(narrowest, level);
    const glm::vec3 extent = shared::disc_extent(alpha, beta), reach = shared::cell_reach(alpha, beta, size);
    const glm::ivec3 low = shared::grid_cell(position - extent, size),
                     high = shared::grid_cell(position + extent, size);
    for (int z = low.z; z <= high.z; ++z)
      for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x) {
          const glm::ivec3 cell(x, y, z);
          if (shared::disc_meets_cell(size * glm::vec3(cell) - position, alpha, beta, glm::cross(alpha, beta), reach))
            entries.push_back({shared::cell_key(cell, level, mask), i});
        }
  }
  return entries;
}

struct Listing {
  std::vector<std::uint32_t> listed;
  std::vector<glm::uvec2> cells;
};

// Of discs [first, first + the value returned by build).
Listing build(const std::vector<shared::PhotonDisc>& discs, std::uint32_t mask, std::size_t capacity, bool texel,
              std::vector<std::uint32_t>* parts = nullptr) {
  const auto count = static_cast<std::uint32_t>(discs.size());
  const gpu::Device device = gpu::Device::open("auto", true);
  passes::PhotonBuffers photons(device, count, false);
  photons.discs.upload(discs);
  const passes::Grid grid = make_grid(mask);
  passes::CellsPass cells(device, photons, capacity, grid.cells(), texel);
  gpu::Commands commands(device);
  cells.build(commands, grid, 0, count / 2);  // the second finds a used table
  for (std::uint32_t first = 0; first < count;) {
    const std::uint32_t taken = cells.build(commands, grid, first, count - first);
    first += taken;
    if (parts) parts->push_back(taken);
  }
  commands.submit_and_wait();
  EXPECT_TRUE(device.validation_messages().empty());
  return {cells.listed.download<std::uint32_t>(), cells.cells.download<glm::uvec2>()};
}

// (photons, cells of a level, by texel buffers, of which some devices allow 65,536 texels)
class Cells : public testing::TestWithParam<std::tuple<std::uint32_t, std::uint32_t, bool>> {};

TEST_P(Cells, ListTheirPhotonsInOrder) {
  REQUIRE_DEVICE();
  const auto [count, per_level, texel] = GetParam();
  const std::vector<shared::PhotonDisc> discs = random_discs(count);
  auto expected = entries_of(discs, per_level - 1);
  std::ranges::stable_sort(expected, {}, [](const auto& e) { return e.first; });
  const Listing found = build(discs, per_level - 1, expected.size(), texel);
  std::size_t twice = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const bool again = i > 0 && expected[i] == expected[i - 1];
    twice += again ? 1 : 0;
    ASSERT_EQ(found.listed[i], expected[i].second | (again ? shared::LISTED_TWICE : 0)) << "place " << i;
  }
  EXPECT_EQ(twice > 0, per_level < 1000) << twice << " of " << expected.size() << " entries are repeated";
  for (std::uint32_t key = 0; key < levels * per_level; ++key) {
    const auto key_of = [](const auto& e) { return e.first; };
    const auto first = std::ranges::lower_bound(expected, key, {}, key_of),
               last = std::ranges::upper_bound(expected, key, {}, key_of);
    const glm::uvec2 wanted(first - expected.begin(), last - expected.begin());
    if (first == last)
      ASSERT_EQ(found.cells[key].x, found.cells[key].y) << "cell " << key;
    else
      ASSERT_EQ(found.cells[key], wanted) << "cell " << key;
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Cells,
                         testing::Values(std::tuple{3u, 1u << 12, true}, std::tuple{255u, 16u, false},
                                         std::tuple{257u, 64u, true}, std::tuple{4001u, 1u << 7, true},
                                         std::tuple{100003u, 1u << 8, false}),
                         [](const auto& tested) { return std::to_string(std::get<0>(tested.param)); });

// Whatever point of a disc a pixel sees, the cell there lists the photon, once.
TEST(CellsOfDiscs, HoldEveryPointOfThem) {
  REQUIRE_DEVICE();
  constexpr std::uint32_t mask = (1u << 12) - 1;
  const std::vector<shared::PhotonDisc> discs = random_discs(2000);
  const Listing found = build(discs, mask, passes::entry_capacity(discs.size()), true);
  std::mt19937 random(1);
  for (std::uint32_t i = 0; i < discs.size(); ++i) {
    const auto& [position, red, alpha, green, beta, blue] = discs[i];
    if (alpha == glm::vec3(0)) continue;
    const float level_size = shared::level_cell_size(narrowest, shared::disc_level(alpha, beta, narrowest, levels));
    for (int k = 0; k < 50; ++k) {
      // Near the rim as often as inside.
      const float a = uniform(random, 0, 6.2831f), r = k % 2 == 0 ? 0.999f : uniform(random, 0, 1);
      const glm::vec3 normal = glm::normalize(glm::cross(alpha, beta));
      const glm::vec3 point = position + r * std::cos(a) * alpha / glm::dot(alpha, alpha) +
                              r * std::sin(a) * beta / glm::dot(beta, beta) +
                              uniform(random, -0.999f, 0.999f) * shared::DISC_THICKNESS / glm::length(alpha) * normal;
      const std::uint32_t level = shared::disc_level(alpha, beta, narrowest, levels);
      const glm::uvec2 range = found.cells[shared::cell_key(shared::grid_cell(point, level_size), level, mask)];
      ASSERT_EQ(std::count(found.listed.begin() + range.x, found.listed.begin() + range.y, i), 1) << "photon " << i;
    }
  }
}

TEST(CellsOfDiscs, TakeAsManyPhotonsAsThereIsRoomFor) {
  REQUIRE_DEVICE();
  constexpr std::uint32_t mask = (1u << 8) - 1;
  const std::vector<shared::PhotonDisc> discs = random_discs(3000);
  const std::size_t all = entries_of(discs, mask).size();
  std::vector<std::uint32_t> parts;
  const Listing found = build(discs, mask, all / 3, true, &parts);
  EXPECT_GE(parts.size(), 4u);
  EXPECT_EQ(std::accumulate(parts.begin(), parts.end(), 0u), discs.size());
  // The last part alone is in the grid now.
  const auto entries = entries_of(discs, mask);
  const auto last = static_cast<std::uint32_t>(discs.size()) - parts.back();
  std::vector<std::uint32_t> expected, listed;
  for (const auto& [key, i] : entries)
    if (i >= last) expected.push_back(i);
  for (std::size_t k = 0; k < expected.size(); ++k) listed.push_back(found.listed[k] & ~shared::LISTED_TWICE);
  std::ranges::sort(expected);
  std::ranges::sort(listed);
  EXPECT_EQ(listed, expected);
}

}  // namespace
}  // namespace meniscal

// The presets lie near the front of what a sweep of `meniscal tradeoff` finds.
#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "gtest/gtest.h"
#include "tests/unit/program.h"

namespace meniscal {
namespace {

using test::meniscal;
using test::TemporaryFolder;

// What a preset's error may be of the least that no more CPU seconds buy.
constexpr double kMost = 1.2;

struct Row {
  std::string knob, preset, options;
  double seconds = 0, error = 0;
};

std::vector<Row> rows_of(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line.rfind("knob,preset,value,options,cpu_s,wall_s,relative_rmse,", 0), 0u) << line;
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    std::vector<std::string> cell(7);
    for (std::string& c : cell) std::getline(cells, c, ',');
    rows.push_back({cell[0], cell[1], cell[3], std::stod(cell[4]), std::stod(cell[6])});
  }
  return rows;
}

const Row& best_within(const std::vector<Row>& rows, const Row& preset) {
  const Row* best = &preset;
  for (const Row& row : rows)
    if (row.seconds <= preset.seconds && row.error < best->error) best = &row;
  return *best;
}

void expect_presets_near_the_front(const std::string& scene, const std::string& resolution) {
  const TemporaryFolder folder;
  const test::Outcome o =
      meniscal(folder, fmt::format("tradeoff \"{}/{}.gltf\" -o \"{}\" --resolution {} --reference-passes 16 --quiet",
                                   SCENES, scene, folder / "sweep.html", resolution));
  ASSERT_EQ(o.code, 0) << o.error;
  const std::vector<Row> rows = rows_of(test::read_bytes(folder / "sweep.csv"));
  std::vector<Row> presets;
  for (const Row& row : rows)
    if (row.knob == "preset") presets.push_back(row);
  ASSERT_EQ(presets.size(), 3u);
  EXPECT_GT(rows.size(), 50u);
  for (const Row& preset : presets) {
    const Row& best = best_within(rows, preset);
    EXPECT_LE(preset.error, kMost * best.error)
        << scene << ": " << preset.options << " has an error of " << preset.error << " in " << preset.seconds
        << " CPU s, and " << best.options << " one of " << best.error << " in " << best.seconds << " CPU s";
  }
  // They differ in what they are for.
  for (std::size_t i = 1; i < presets.size(); ++i) {
    EXPECT_LT(presets[i - 1].seconds, presets[i].seconds) << scene << ": " << presets[i].options;
    EXPECT_GT(presets[i - 1].error, presets[i].error) << scene << ": " << presets[i].options;
  }
}

TEST(Presets, SlowAreNearTheFrontOfAPostInWater) { expect_presets_near_the_front("post", "128x96"); }
TEST(Presets, SlowAreNearTheFrontOfATank) { expect_presets_near_the_front("tank", "128x96"); }
TEST(Presets, SlowAreNearTheFrontOfACurledHair) { expect_presets_near_the_front("curled_hair", "128x96"); }
TEST(Presets, SlowAreNearTheFrontOfAShadowSausage) { expect_presets_near_the_front("shadow_sausage", "128x96"); }

}  // namespace
}  // namespace meniscal

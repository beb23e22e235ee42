// The presets lie near the front of what sweeps of `meniscal tradeoff` find. A preset is one setting for every scene,
// so settings are compared over several: by geometric means of their errors and CPU seconds, relative to the preset's
// own.
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <sstream>

#include "gtest/gtest.h"
#include "tests/unit/program.h"

namespace meniscal {
namespace {

using test::meniscal;
using test::TemporaryFolder;

// What a preset's error may be of the least that no more CPU seconds buy.
constexpr double kMost = 1.2;
const char* const kScenes[] = {"post", "tank", "curled_hair", "shadow_sausage"};

struct Cost {
  double seconds, error;
};
// By preset, knob and place among the knob's values: those in metres differ from scene to scene.
using Sweep = std::map<std::string, Cost>;

Sweep sweep(const std::string& scene) {
  const TemporaryFolder folder;
  const test::Outcome o = meniscal(
      folder, fmt::format("tradeoff \"{}/{}.gltf\" -o \"{}\" --resolution 128x96 --reference-passes 16 --quiet", SCENES,
                          scene, folder / "sweep.html"));
  EXPECT_EQ(o.code, 0) << o.error;
  std::istringstream lines(test::read_bytes(folder / "sweep.csv"));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line.rfind("knob,preset,value,options,cpu_s,wall_s,relative_rmse,", 0), 0u) << line;
  Sweep costs;
  std::map<std::string, int> values;
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    std::vector<std::string> cell(7);
    for (std::string& c : cell) std::getline(cells, c, ',');
    const std::string knob = cell[1] + (cell[0] == "preset" ? "" : ", " + cell[0]);
    costs[cell[0] == "preset" ? knob : fmt::format("{} {}", knob, ++values[knob])] = {std::stod(cell[4]),
                                                                                      std::stod(cell[6])};
  }
  return costs;
}

TEST(Presets, SlowAreNearTheFrontOfSweepsOverScenes) {
  std::vector<Sweep> sweeps;
  for (const char* scene : kScenes) sweeps.push_back(sweep(scene));
  for (const std::string preset : {"draft", "preview", "final"}) {
    for (const auto& [setting, unused] : sweeps[0]) {
      double seconds = 0, error = 0;
      bool everywhere = true;
      for (const Sweep& s : sweeps) {
        everywhere = everywhere && s.contains(setting);
        if (!everywhere) break;
        seconds += std::log(s.at(setting).seconds / s.at(preset).seconds);
        error += std::log(s.at(setting).error / s.at(preset).error);
      }
      const double count = double(sweeps.size());
      if (!everywhere || seconds > 0) continue;
      EXPECT_GE(std::exp(error / count), 1 / kMost)
          << setting << " has " << std::exp(error / count) << " of the error of " << preset << " in "
          << std::exp(seconds / count) << " of its CPU seconds";
    }
  }
  for (const Sweep& s : sweeps) {
    EXPECT_LT(s.at("draft").seconds, s.at("preview").seconds);
    EXPECT_LT(s.at("preview").seconds, s.at("final").seconds);
    EXPECT_GT(s.at("draft").error, s.at("preview").error);
    EXPECT_GT(s.at("preview").error, s.at("final").error);
  }
}

}  // namespace
}  // namespace meniscal

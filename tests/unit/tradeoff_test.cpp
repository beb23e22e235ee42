// The trade of speed for accuracy: what is tried, the front, the table.
#include <cmath>
#include <limits>
#include <set>

#include "gtest/gtest.h"
#include "host/tradeoff/chart.h"
#include "host/tradeoff/report.h"

namespace meniscal {
namespace {

using Indices = std::vector<std::size_t>;

TEST(Front, HoldsWhatNothingDominates) {
  //                                 0         1         2         3 dominated by 0   4 dominated by 1 at equal cost
  const std::vector<Trade> trades = {{2, 0.5}, {4, 0.2}, {1, 0.9}, {3, 0.6}, {4, 0.3}};
  EXPECT_EQ(pareto_front(trades), (Indices{2, 0, 1}));
}

TEST(Front, KeepsOneOfEqualsAndNoneThatIsUnknown) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const std::vector<Trade> trades = {{1, nan}, {2, 0.5}, {2, 0.5}, {3, 0.5}, {0.5, infinity}, {5, 0}};
  EXPECT_EQ(pareto_front(trades), (Indices{1, 5}));
  EXPECT_TRUE(pareto_front({}).empty());
}

TEST(Front, SaysWhatSecondsBuy) {
  const std::vector<Trade> trades = {{2, 0.5}, {4, 0.2}, {1, 0.9}};
  const Indices front = pareto_front(trades);
  EXPECT_EQ(best_within(trades, front, 3.9), 0u);
  EXPECT_EQ(best_within(trades, front, 4), 1u);
  EXPECT_EQ(best_within(trades, front, 0.5), std::nullopt);
}

std::vector<Point> two_points() {
  return {{{"preset", "draft", "draft", {"--quality", "draft"}}, 2, 1, {0.5, 0.8, 0.1}},
          {{"photons", "draft", "100", {"--quality", "draft", "--photons", "100"}},
           1.5,
           3,
           {0.25, std::numeric_limits<double>::quiet_NaN(), 0.2}}};
}

TEST(Table, HasARowAPoint) {
  EXPECT_EQ(as_csv(two_points(), Clock::cpu),
            "knob,preset,value,options,cpu_s,wall_s,relative_rmse,front_relative_rmse,caustic_rmse,front_caustic_rmse,"
            "flip,front_flip\r\n"
            "preset,draft,draft,--quality draft,2.0000,1.0000,0.5,0,0.8,1,0.1,1\r\n"
            "photons,draft,100,--quality draft --photons 100,1.5000,3.0000,0.25,1,,0,0.2,1\r\n");
}

TEST(Advice, IsTheBestThatCostsNoMore) {
  const auto by_cpu = advice(two_points(), Clock::cpu, measures[0]);
  ASSERT_EQ(by_cpu.size(), 1u);
  EXPECT_EQ(by_cpu[0].best, 1u);
  EXPECT_DOUBLE_EQ(by_cpu[0].ratio, 2);
  const auto by_wall = advice(two_points(), Clock::wall, measures[0]);  // the other takes three times as long
  EXPECT_EQ(by_wall[0].best, 0u);
  EXPECT_DOUBLE_EQ(by_wall[0].ratio, 1);
}

const std::vector<SweptPreset> kPresets = {{"draft", 1000, 1, 1, 16, 8, false}, {"final", 4000, 2, 4, 16, 8, true}};

TEST(Sweep, TurnsOneKnobAtATimeAndNothingTwice) {
  const Sweep sweep = make_sweep(kPresets, {true, true, 1e-3}, false);
  std::set<std::string> lines;
  for (const Setting& s : sweep.settings) EXPECT_TRUE(lines.insert(command_line(s)).second) << command_line(s);
  for (const char* line : {"--quality draft", "--quality draft --photons 250", "--quality final --photons 16000",
                           "--quality final --final-gathering off", "--quality draft --meniscus paper",
                           "--quality final --meniscus-tolerance 0.5", "--quality draft --radius 0.002"})
    EXPECT_TRUE(lines.contains(line)) << line;
  for (const Curve& c : sweep.curves) {
    ASSERT_EQ(c.settings.size(), c.values.size());
    for (const std::size_t i : c.settings) EXPECT_EQ(sweep.settings.at(i).preset, c.preset);
    if (c.knob == "photons" && c.preset == "final") {
      EXPECT_EQ(c.values, (std::vector<std::string>{"1000", "4000", "16000"}));
      EXPECT_EQ(c.settings[1], 1u);  // the preset itself
    }
  }
}

TEST(Sweep, LeavesOutKnobsOfWhatTheSceneHasNot) {
  for (const Setting& s : make_sweep(kPresets, {false, false, 1e-3}, false).settings) {
    EXPECT_EQ(command_line(s).find("meniscus"), std::string::npos);
    EXPECT_EQ(command_line(s).find("highlight"), std::string::npos);
  }
}

Image grey(const std::vector<float>& values, const std::vector<float>& targeted) {
  Image image;
  image.width = static_cast<int>(values.size()), image.height = 1;
  image.layers = {{"", {"R", "G", "B"}, {}}, {"targeted", {"R", "G", "B"}, {}}};
  for (const float v : values) image.layers[0].pixels.insert(image.layers[0].pixels.end(), 3, v);
  for (const float v : targeted) image.layers[1].pixels.insert(image.layers[1].pixels.end(), 3, v);
  return image;
}

TEST(Errors, OfTheCausticCountItsPixelsAlone) {
  // Pixels 0 and 1 are the caustic; 2 has less than a twentieth of its light.
  const Reference reference(grey({3, 4, 12}, {2, 3, 0.1f}), ToneMap::ward, std::nullopt);
  EXPECT_EQ(reference.caustic_pixels(), 2u);
  const Errors e = reference.errors_of(grey({3, 5, 14}, {}));
  EXPECT_NEAR(e.caustic, 1.0 / 5, 1e-7);
  EXPECT_NEAR(e.image, std::sqrt(5.0) / 13, 1e-7);
  EXPECT_GT(e.flip, 0);
  EXPECT_EQ(reference.errors_of(reference.image()).flip, 0);
  EXPECT_TRUE(std::isnan(Reference(grey({1}, {0}), ToneMap::ward, std::nullopt).errors_of(grey({1}, {})).caustic));
}

TEST(Chart, PlacesDecadesEvenlyAndEscapesText) {
  const Chart chart{
      "a < b",
      "s",
      "e",
      {{"draft", {{1, 1, "one", ""}, {10, 10, "\"ten\"", ""}, {100, 100, "", ""}, {0, 1, "", "zero"}}, true}}};
  const std::string svg = as_svg(chart);
  EXPECT_NE(svg.find("a &lt; b"), std::string::npos);
  EXPECT_NE(svg.find("&quot;ten&quot;"), std::string::npos);
  EXPECT_EQ(svg.find("zero"), std::string::npos);
  double x[3], y[3];
  ASSERT_EQ(std::sscanf(svg.c_str() + svg.find("points=\""), "points=\"%lf,%lf %lf,%lf %lf,%lf\"", x, y, x + 1, y + 1,
                        x + 2, y + 2),
            6);
  EXPECT_NEAR(x[1] - x[0], x[2] - x[1], 0.11);  // printed to a tenth
  EXPECT_NEAR(y[1] - y[0], y[2] - y[1], 0.11);
  EXPECT_GT(x[1], x[0]);
  EXPECT_LT(y[1], y[0]);  // upwards
}

}  // namespace
}  // namespace meniscal

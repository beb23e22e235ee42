// Only what a scene requires is run: of an absent feature no pass, buffer, shader variant or stage is left.
#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "tests/support/feature_pairs.h"

namespace meniscal {
namespace {

using nlohmann::ordered_json;

ordered_json statistics_of(const test::FeatureRun& run) {
  return statistics_json(run.setup->world, run.setup->settings, MeniscusModel::paper, run.statistics);
}

// By name, as in FeaturePair::marks: a constant where it is not 0, that is, where the shader has what it stands for.
std::set<std::string> what_ran(const ordered_json& statistics) {
  std::set<std::string> marks;
  const ordered_json& ran = statistics.at("ran");
  for (const ordered_json& pass : ran.at("passes")) {
    marks.insert("pass " + pass.at("name").get<std::string>());
    for (const auto& [name, value] : pass.at("variant").items())
      if (value != 0) marks.insert("constant " + name);
    for (const auto& [stage, count] : pass.at("dispatches").items()) marks.insert("stage " + stage);
  }
  for (const auto& [name, bytes] : ran.at("buffers").items()) marks.insert("buffer " + name);
  for (const auto& [name, seconds] : ran.at("stages").items()) marks.insert("stage " + name);
  for (const char* map : {"targeted", "caustic", "global"})
    if (statistics.at("photons").at(map).at("started") > 0) marks.insert(std::string("photons ") + map);
  return marks;
}

bool planned(const ordered_json& statistics, const std::string& feature) {
  for (const ordered_json& entry : statistics.at("plan"))
    if (entry.at("feature") == feature) return entry.at("on");
  ADD_FAILURE() << feature << " is not of the plan";
  return false;
}

std::set<std::string> operator-(const std::set<std::string>& a, const std::set<std::string>& b) {
  std::set<std::string> left;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::inserter(left, left.end()));
  return left;
}
std::set<std::string> operator&(const std::set<std::string>& a, const std::set<std::string>& b) { return a - (a - b); }

class Required : public testing::TestWithParam<test::FeaturePair> {};

TEST_P(Required, AnAbsentFeatureLeavesNoTrace) {
  REQUIRE_DEVICE();
  const test::FeaturePair& pair = GetParam();
  const ordered_json with = statistics_of(test::run_feature(pair.make(true), "auto")),
                     without = statistics_of(test::run_feature(pair.make(false), "auto"));
  EXPECT_TRUE(planned(with, pair.feature));
  EXPECT_FALSE(planned(without, pair.feature));
  const std::set<std::string> none;
  EXPECT_EQ(what_ran(with) - what_ran(without), pair.marks) << "with it, this and nothing else is added";
  EXPECT_EQ(what_ran(without) & pair.marks, none);
}

// The reference path has neither passes nor buffers, but stages and photons.
TEST_P(Required, NorDoesItOnTheReferencePath) {
  const test::FeaturePair& pair = GetParam();
  const std::set<std::string> with = what_ran(statistics_of(test::run_feature(pair.make(true), "cpu"))),
                              without = what_ran(statistics_of(test::run_feature(pair.make(false), "cpu")));
  std::set<std::string> expected;
  for (const std::string& mark : pair.marks)
    if (mark.starts_with("stage ") || mark.starts_with("photons ")) expected.insert(mark);
  for (const std::string stage : {"grid", "gather"})  // of all maps together
    if (expected.erase("stage global " + stage) > 0) expected.insert("stage " + stage);
  EXPECT_EQ(with - without, expected);
  EXPECT_EQ(without & pair.marks, std::set<std::string>());
}

INSTANTIATE_TEST_SUITE_P(Features, Required, testing::ValuesIn(test::feature_pairs()), [](const auto& tested) {
  std::string name = tested.param.feature;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
});

TEST(OnlyWhatIsRequired, EveryFeatureOfThePlanHasAPair) {
  const auto setup = test::make_setup(test::bare_scene().scene, test::bare_scene().options);
  std::vector<std::string> planned, paired;
  for (const PlanEntry& e : make_plan(setup->world, 0, glm::uvec4(0))) planned.push_back(e.feature);
  for (const test::FeaturePair& p : test::feature_pairs()) paired.push_back(p.feature);
  EXPECT_EQ(paired, planned);
}

TEST(OnlyWhatIsRequired, MaterialsOfNoObjectCostNothing) {
  REQUIRE_DEVICE();
  test::FeatureScene bare = test::bare_scene(), more = test::bare_scene();
  Material frosted = test::make_clear("frosted", 1.5), mirror = test::make_matte("mirror");
  frosted.roughness = 0.4;
  frosted.absorption = glm::dvec3(1);
  mirror.metallic = 1;
  mirror.roughness = 0;
  mirror.base_color_texture = test::make_texture(
      test::make_image(2, 2, false, [](std::uint32_t, std::uint32_t) { return glm::uvec4(9); }), true);
  for (const Material& m : {frosted, mirror, test::make_clear("glass", 1.5), test::make_matte("glossy")})
    test::add_material(more.scene, m);
  const ordered_json without = statistics_of(test::run_feature(bare, "auto")),
                     with = statistics_of(test::run_feature(more, "auto"));
  EXPECT_EQ(what_ran(with), what_ran(without));
  EXPECT_EQ(with.at("plan"), without.at("plan"));
}

TEST(OnlyWhatIsRequired, WithoutLightThereIsNoInterreflection) {
  REQUIRE_DEVICE();
  test::FeatureScene dark = test::bare_scene();
  dark.scene.lights.clear();
  dark.options.diffuse_bounces = 4;
  dark.options.quality = Quality::final;
  const ordered_json statistics = statistics_of(test::run_feature(dark, "auto"));
  EXPECT_FALSE(planned(statistics, "interreflection"));
  const std::set<std::string> expected = {"pass paths",           "stage camera",          "stage upload",
                                          "stage compile",        "buffer camera",         "buffer scene",
                                          "buffer normals",       "buffer counters",       "buffer surfaces",
                                          "buffer pixel samples", "constant SCENE_RADIUS", "constant TRIANGLE_BASE"};
  EXPECT_EQ(what_ran(statistics), expected);
}

}  // namespace
}  // namespace meniscal

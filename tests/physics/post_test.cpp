// The floor under a vertical post against exact tables: the paper's profile, vertical light.
#include <cmath>

#include "tests/support/csv.h"
#include "tests/support/rings.h"

namespace meniscal {
namespace {

void set_post(Scene& scene, const std::string& rule, double theta) {
  for (Material& m : scene.materials) {
    if (m.liquid) m.liquid->height_rule = rule;
    if (m.name == "post") m.contact_angle = theta;
  }
}

struct Case {
  std::string shape, column;  // "full" or "stub"; "A" equation2, "B" wetting
  int theta;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.shape << "_" << c.column << "_" << c.theta; }

class Post : public testing::TestWithParam<Case> {};

TEST_P(Post, FloorAndFluxFollowTheTables) {
  REQUIRE_DEVICE();
  const Case& c = GetParam();
  const auto setup =
      test::make_setup(c.shape == "full" ? "post" : "post_stub", test::post_options(),
                       [&](Scene& scene) { set_post(scene, c.column == "B" ? "wetting" : "equation2", c.theta); });
  const test::Rings rings = test::render_rings(*setup, 3);

  const std::string data = std::string(TEST_DATA) + "/", column = c.column + "_theta_" + std::to_string(c.theta);
  const auto table = test::read_csv(data + "caustic_paper_cyl_R2_H50_" + c.shape + ".csv");
  std::vector<double> truth;
  for (const test::Row& row : table) truth.push_back(test::number(row, column));
  const test::Deviation off = test::compare(rings, truth);
  EXPECT_LT(off.rms, 0.02);

  const std::string name = "paper" + c.column + " R2 H50 " + c.shape + " theta" + std::to_string(c.theta);
  const Tally& tally = rings.tallies[shared::MAP_TARGETED];
  const auto landed_mm2 = [&](const std::string& material) {
    double flux = 0;
    for (std::size_t i = 0; i < tally.flux_landed.size(); ++i)
      if (setup->world.material_names[i] == material) flux += tally.flux_landed[i] / 3 * 1e6;
    return flux;
  };
  for (const test::Row& row : test::read_csv(data + "caustic_accounting.csv")) {
    if (row.at("case") != name) continue;
    const double absorbed = test::number(row, "absorbed_by_solid"), mirrored = test::number(row, "mirrored");
    EXPECT_NEAR(tally.flux_in / 3 * 1e6, test::number(row, "incident"), 0.005 * test::number(row, "incident"));
    EXPECT_NEAR(landed_mm2("floor"), test::number(row, "floor_in_table"), 0.005 * test::number(row, "floor_in_table"));
    // Some 2 % of the photons are mirrored: beyond the tolerance their number's own noise, 3 sigma, is allowed for.
    const double mirrored_count = double(tally.kept) * mirrored / test::number(row, "incident");
    const double mirrored_tolerance = mirrored * std::max(0.005, 3 / std::sqrt(mirrored_count));
    const double post = landed_mm2("post"), up = tally.flux_escaped / 3 * 1e6;
    std::printf("%s: rms %.4f, floor %.3f, post %.3f, up %.3f mm2\n", name.c_str(), off.rms, landed_mm2("floor"), post,
                up);
    if (absorbed > 0) {
      EXPECT_NEAR(post, absorbed, 0.005 * absorbed);
      EXPECT_NEAR(up, mirrored, mirrored_tolerance);
    } else {
      // A depression mirrors part of the light onto the post's dry side: the table counts it as mirrored.
      EXPECT_NEAR(post + up, mirrored, mirrored_tolerance);
    }
    return;
  }
  FAIL() << "no row " << name;
}

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const char* shape : {"full", "stub"})
    for (const char* column : {"A", "B"})
      for (int theta : {30, 60, 120}) cases.push_back({shape, column, theta});
  return cases;
}
INSTANTIATE_TEST_SUITE_P(Tables, Post, testing::ValuesIn(all_cases()), [](const auto& tested) {
  return tested.param.shape + "_" + tested.param.column + "_" + std::to_string(tested.param.theta);
});

TEST(Floor, WithoutMenisciReadsTheFresnelTransmittance) {
  REQUIRE_DEVICE();
  RenderOptions options = test::post_options();
  options.meniscus = MeniscusModel::none;
  const auto setup = test::make_setup("post", options);
  EXPECT_EQ(test::find_stratum(setup->world, "targeted"), nullptr);
  EXPECT_NEAR(test::mean_beyond(test::render_rings(*setup, 2), 2.3, 12), 0.979627, 1e-3);
}

TEST(Floor, UnderALiquidOfIndexOneReadsOne) {
  REQUIRE_DEVICE();
  const auto setup = test::make_setup("post", test::post_options(), [](Scene& scene) {
    for (Material& m : scene.materials)
      if (m.liquid) m.ior = 1;
  });
  ASSERT_NE(test::find_stratum(setup->world, "targeted"), nullptr);
  EXPECT_NEAR(test::mean_beyond(test::render_rings(*setup, 2), 2.3, 12), 1, 1e-3);
}

}  // namespace
}  // namespace meniscal

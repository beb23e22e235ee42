// The floor under the menisci of Young-Laplace's equation against exact tables: a vertical post, light from above.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/csv.h"
#include "tests/support/rings.h"

namespace meniscal {
namespace {

constexpr double far_transmittance = 0.979627;  // of level water, n = 1.333

struct Case {
  std::string shape, light;  // "full" or "stub"; "" vertical and parallel, or the prefix of the table's column
  int theta;
  double angular_radius = 0;  // of the light, degrees
  std::string column() const { return light + "theta_" + std::to_string(theta); }
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.shape << " " << c.column(); }

// The table's post takes none of the slanted light above the water.
void cut_top(Scene& scene) {
  for (Object& o : scene.objects)
    if (scene.materials[o.material].name == "post")
      for (glm::dvec3& p : o.mesh.positions) p.y = std::min(p.y, 1e-5 - scene.origin.y);
}

class ExactPost : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    REQUIRE_DEVICE();
    const Case& c = GetParam();
    RenderOptions options = test::post_options();
    options.meniscus = MeniscusModel::exact;
    setup = test::make_setup(c.shape == "full" ? "post" : "post_stub", options, [&](Scene& scene) {
      for (Material& m : scene.materials)
        if (m.name == "post") m.contact_angle = c.theta;
      for (PunctualLight& l : scene.lights) l.angular_diameter = glm::radians(2 * c.angular_radius);
      if (c.angular_radius > 1) cut_top(scene);
    });
    EXPECT_EQ(setup->world.liquids.front().solution.failed, 0u);
    rings = test::render_rings(*setup, passes);
    for (const test::Row& row : test::read_csv(data + "caustic_exact_cyl_R2_H50_" + c.shape + ".csv"))
      truth.push_back(test::number(row, c.column()));
  }
  void check_floor(), check_under_stub(), check_fold(), check_accounts();

  // Flux on what is of this material, relative to the irradiance of the light; mm2.
  double landed_mm2(const std::string& material) const {
    double flux = 0;
    for (const int map : {shared::MAP_TARGETED, shared::MAP_CAUSTIC}) {
      const Tally& tally = rings.tallies[static_cast<std::size_t>(map)];
      for (std::size_t i = 0; i < tally.flux_landed.size(); ++i)
        if (setup->world.material_names[i] == material) flux += tally.flux_landed[i] / passes * 1e6;
    }
    return flux;
  }
  static double flux_mm2(const std::vector<double>& irradiance, double from_mm, double to_mm) {
    double flux = 0;
    for (std::size_t i = 0; i < std::min<std::size_t>(irradiance.size(), 240); ++i) {
      const double r = (double(i) + 0.5) * test::ring_mm;
      if (r > from_mm && r < to_mm) flux += irradiance[i] * 2 * std::numbers::pi * r * test::ring_mm;
    }
    return flux;
  }

  static constexpr std::uint32_t passes = 3;
  const std::string data = std::string(TEST_DATA) + "/";
  std::unique_ptr<test::Setup> setup;
  test::Rings rings;
  std::vector<double> truth;
};

TEST_P(ExactPost, FloorAndFluxFollowTheTables) {
  check_floor();
  if (GetParam().shape == "stub") check_under_stub();
  if (GetParam().theta > 90 && GetParam().angular_radius == 0) check_fold();
  if (GetParam().angular_radius == 0) check_accounts();
}

void ExactPost::check_floor() {
  const test::Deviation off = test::compare(rings, truth);
  std::printf("rms %.4f, worst %.4f of %d rings\n", off.rms, off.worst, off.rings);
  EXPECT_LT(off.rms, 0.02);
  EXPECT_LT(off.worst, 0.05);
  EXPECT_NEAR(flux_mm2(rings.irradiance, 2.5, 12), flux_mm2(truth, 2.5, 12), 0.005 * flux_mm2(truth, 2.5, 12));
}

void ExactPost::check_under_stub() {
  for (const auto& [from, to] : {std::pair{0.0, 0.5}, {0.5, 1.0}, {1.0, 1.5}, {1.5, 2.0}}) {
    const double expected = flux_mm2(truth, from, to);
    std::printf("%.1f to %.1f mm: %.4f for %.4f mm2\n", from, to, flux_mm2(rings.irradiance, from, to), expected);
    EXPECT_NEAR(flux_mm2(rings.irradiance, from, to), expected, 0.05 * expected + 0.01)
        << from;  // mm2: blur of an edge
  }
}

// Where a depression throws its light: the radius at which the irradiance falls through the middle between the bright
// edge and the outside.
void ExactPost::check_fold() {
  const auto brightest = std::max_element(truth.begin() + 50, truth.begin() + 240) - truth.begin();
  const auto edge = [&](const std::vector<double>& irradiance) {
    double gained = 0;  // flux beyond the outside's, from well within the fold outward
    const double outside = irradiance[brightest + 12];
    double moment = 0;
    for (auto i = brightest - 12; i <= brightest + 12; ++i) {
      const double more = std::abs(irradiance[i] - outside);
      gained += more, moment += more * (double(i) + 0.5) * test::ring_mm;
    }
    return moment / gained;
  };
  std::printf("fold: centre of light %.4f for %.4f mm\n", edge(rings.irradiance), edge(truth));
  EXPECT_NEAR(edge(rings.irradiance), edge(truth), 0.05);
}

void ExactPost::check_accounts() {
  const Case& c = GetParam();
  const std::string name = "exact R2 H50 " + c.shape + " theta" + std::to_string(c.theta);
  const std::vector<test::Row> rows = test::read_csv(data + "caustic_accounting.csv");
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const test::Row& r) { return r.at("case") == name; });
  ASSERT_NE(row, rows.end()) << name;
  double in = 0, up = 0, error_up = 0;
  const double post = landed_mm2("post");
  for (const int map : {shared::MAP_TARGETED, shared::MAP_CAUSTIC}) {
    const Tally& tally = rings.tallies[static_cast<std::size_t>(map)];
    const double mm2 = 1e6 / passes, escaped = tally.flux_escaped * mm2,
                 each = tally.flux_in * mm2 / double(tally.kept);
    in += tally.flux_in * mm2, up += escaped, error_up += escaped * each;
  }
  const Tally& targeted = rings.tallies[shared::MAP_TARGETED];  // whose photons alone reach the post
  const double error_post = std::sqrt(post * targeted.flux_in * 1e6 / passes / double(targeted.kept));
  error_up = std::sqrt(error_up);
  const double absorbed = test::number(*row, "absorbed_by_solid");
  // The table's beam is wider or narrower than ours: the water there is level.
  const double mirrored =
      test::number(*row, "mirrored") + (in - test::number(*row, "incident")) * (1 - far_transmittance);
  std::printf("%s: post %.3f +- %.3f for %.3f, mirrored %.3f +- %.3f for %.3f\n", name.c_str(), post, error_post,
              absorbed, up, error_up, mirrored);
  const auto expect = [](double is, double expected, double noise) {
    EXPECT_NEAR(is, expected, std::max(0.005 * expected, 3 * noise));
  };
  if (absorbed > 0 && c.theta > 0) {
    expect(post, absorbed, error_post);
    expect(up, mirrored, error_up);
  } else {
    // What a depression mirrors onto the dry post, and what a vertical surface mirrors down into the water again, the
    // table counts as mirrored.
    expect(post + up, absorbed + mirrored, std::hypot(error_post, error_up));
  }
}

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const char* shape : {"full", "stub"})
    for (int theta : {0, 30, 60, 120, 180}) cases.push_back({shape, "", theta});
  for (int theta : {30, 120}) cases.push_back({"full", "sun_0.2665deg_", theta, 0.2665});
  cases.push_back({"full", "disk_5deg_", 120, 5});
  return cases;
}
INSTANTIATE_TEST_SUITE_P(Tables, ExactPost, testing::ValuesIn(all_cases()), [](const auto& tested) {
  const Case& c = tested.param;
  return c.shape +
         (c.angular_radius > 1   ? "_disk"
          : c.angular_radius > 0 ? "_sun"
                                 : "") +
         "_" + std::to_string(c.theta);
});

}  // namespace
}  // namespace meniscal

// The floor beside a wall that is wetted by the exact meniscus, under upright and tilted light, against exact tables.
#include <algorithm>
#include <cmath>

#include "tests/support/csv.h"
#include "tests/support/scene_setup.h"

namespace meniscal {
namespace {

constexpr double bin_mm = 0.05;

struct Case {
  int theta, psi;  // degrees; the light travels away from the wall for positive ones
  std::string column() const {
    return "theta_" + std::to_string(theta) + (psi == 0 ? "" : "_psi_" + std::to_string(psi));
  }
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.column(); }

// The scene's post made a wall: the half-space x < 0, its top flush with the contact line.
void make_wall(Scene& scene, const Case& c) {
  const double capillary_length = 2.727072e-3;
  const double rise = 2 * capillary_length * std::sin(glm::radians(90.0 - c.theta) / 2);
  for (Object& o : scene.objects) {
    if (scene.materials[o.material].name != "post") {  // tilted light comes from far aside
      for (glm::dvec3& p : o.mesh.positions) p.x *= 2.5, p.z *= 2.5;
      continue;
    }
    const glm::dvec3 low(-0.1, -0.0505, -0.1), high(0, std::max(rise, 0.0) + 2e-5, 0.1);
    meniscus::TriangleMesh box;
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {-1.0, 1.0}) {
        glm::dvec3 normal(0), a(0), b(0), corner = side > 0 ? high : low;
        normal[axis] = side;
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        corner[u] = low[u], corner[v] = low[v];
        a[u] = high[u] - low[u], b[v] = high[v] - low[v];
        const auto first = static_cast<unsigned>(box.positions.size());
        for (const glm::dvec3& p : {corner, corner + a, corner + a + b, corner + b})
          box.positions.push_back(p - scene.origin), box.normals.push_back(normal);
        if (side < 0) std::swap(box.positions[first + 1], box.positions[first + 3]);
        box.triangles.emplace_back(first, first + 1, first + 2);
        box.triangles.emplace_back(first, first + 2, first + 3);
      }
    }
    o.mesh = box;
  }
  for (Material& m : scene.materials)
    if (m.name == "post") m.contact_angle = c.theta;
}

class ExactWall : public testing::TestWithParam<Case> {};

TEST_P(ExactWall, FloorFollowsTheTable) {
  REQUIRE_DEVICE();
  const Case& c = GetParam();
  RenderOptions options = test::small_options(500000, 400, 400);
  options.meniscus = MeniscusModel::exact;
  options.radius = 2.1e-4;
  const auto setup = test::make_setup("post", options, [&](Scene& scene) {
    make_wall(scene, c);
    const double psi = glm::radians(double(c.psi));
    for (PunctualLight& l : scene.lights) {
      l.direction = glm::dvec3(std::sin(psi), -std::cos(psi), 0);
    }
  });
  ASSERT_EQ(setup->world.liquids.front().solution.failed, 0u);
  std::vector<double> truth, sums(240), counts(240);
  for (const test::Row& row : test::read_csv(std::string(TEST_DATA) + "/caustic_exact_wall_H50.csv"))
    truth.push_back(test::number(row, c.column()));
  GpuBackend gpu(gpu::Device::open("auto"), setup->world, setup->settings);
  for (std::uint32_t pass = 0; pass < 3; ++pass) {
    for (const shared::PixelSample& s : test::render_pass(gpu, pass).samples) {
      const double x = 1e3 * double(s.position.x);
      if (s.triangle >= shared::END_FIRST || x < 0 || x >= 12) continue;
      const auto bin = static_cast<std::size_t>(x / bin_mm);
      sums[bin] += double(s.direct.x + s.targeted.x + s.caustic.x), counts[bin] += 1;
    }
  }
  double squares = 0, worst = 0;
  int bins = 0;
  for (int i = 10; i < 220; ++i) {
    bool beside_jump = false;
    for (int k = i - 5; k <= i + 5; ++k) beside_jump = beside_jump || std::abs(truth[k + 1] - truth[k]) > 0.05;
    if (beside_jump || counts[i] == 0) continue;
    const double level = std::cos(glm::radians(double(c.psi)));  // of the irradiance on a level plane
    const double error = (sums[i] / counts[i] / level - truth[i]) / std::max(truth[i], 1.0);
    squares += error * error, worst = std::max(worst, std::abs(error)), ++bins;
  }
  const double rms = std::sqrt(squares / bins);
  std::printf("rms %.4f, worst %.4f of %d bins\n", rms, worst, bins);
  ASSERT_GT(bins, 100);
  EXPECT_LT(rms, 0.02);
  EXPECT_LT(worst, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Tables, ExactWall,
                         testing::Values(Case{0, 0}, Case{30, 0}, Case{60, 0}, Case{120, 0}, Case{180, 0}, Case{30, 15},
                                         Case{30, -30}, Case{60, 30}),
                         [](const auto& tested) {
                           const Case& c = tested.param;
                           return std::to_string(c.theta) + (c.psi < 0 ? "_towards_" : "_away_") +
                                  std::to_string(std::abs(c.psi));
                         });

}  // namespace
}  // namespace meniscal

// The shadow-sausage: the floor under a post that leans by 45 degrees, against a table of the exact meniscus.
#include <algorithm>
#include <cmath>

#include "tests/support/csv.h"
#include "tests/support/scene_setup.h"

namespace meniscal {
namespace {

constexpr double cell_mm = 0.25;

// The scene's post made 160 mm long, through the origin at the water's level, leaning to +x going up.
void lean_post(Scene& scene) {
  for (Object& o : scene.objects) {
    if (scene.materials[o.material].name != "post") continue;
    double low = 1e9, high = -1e9;
    for (const glm::dvec3& p : o.mesh.positions) low = std::min(low, p.y), high = std::max(high, p.y);
    const double half = std::sqrt(0.5);
    const auto lean = [&](const glm::dvec3& v) { return glm::dvec3(half * (v.x + v.y), half * (v.y - v.x), v.z); };
    for (glm::dvec3& p : o.mesh.positions) {
      const double along = 0.16 * ((p.y - low) / (high - low) - 0.5);
      p = lean(glm::dvec3(p.x + scene.origin.x, along, p.z + scene.origin.z)) - scene.origin;
    }
    for (glm::dvec3& n : o.mesh.normals) n = lean(n);
  }
}

TEST(ExactSausage, ShadowIsBrokenAsTheTableSays) {
  REQUIRE_DEVICE();
  RenderOptions options = test::small_options(800000, 400, 400);
  options.meniscus = MeniscusModel::exact;
  options.radius = 2e-4;
  const auto setup = test::make_setup("post", options, lean_post);
  ASSERT_EQ(setup->world.liquids.front().solution.failed, 0u);

  const auto table = test::read_csv(std::string(TEST_DATA) + "/sausage_tilt45_R2_theta30_H50.csv");
  constexpr int rows = 88, columns = 44;  // |x|, |y| below 11 mm
  std::vector<double> sums(rows * columns), counts(rows * columns), truth(rows * columns, -1);
  GpuBackend gpu(gpu::Device::open("auto"), setup->world, setup->settings);
  for (std::uint32_t pass = 0; pass < 6; ++pass) {
    for (const shared::PixelSample& s : test::render_pass(gpu, pass).samples) {
      const int row = static_cast<int>(std::floor(1e3 * double(s.position.x) / cell_mm)) + rows / 2;
      const int column = static_cast<int>(std::abs(1e3 * double(s.position.z)) / cell_mm);
      const bool on_floor = std::abs(double(s.position.y) + setup->scene.origin.y + 0.05) < 1e-6;  // not on the post
      if (s.triangle >= shared::END_FIRST || !on_floor || row < 0 || row >= rows || column >= columns) continue;
      sums[row * columns + column] += double(s.direct.x + s.targeted.x + s.caustic.x);
      counts[row * columns + column] += 1;
    }
  }
  for (const test::Row& line : table) {
    for (const auto& [name, cell] : line) {
      if (name.starts_with("x_")) continue;
      const double x = std::stod(line.at("x_centre_mm \\ |y|_centre_mm")), y = std::stod(name);
      const int row = static_cast<int>(std::floor(x / cell_mm)) + rows / 2, column = static_cast<int>(y / cell_mm);
      if (row >= 0 && row < rows && column < columns) truth[row * columns + column] = std::stod(cell);
    }
  }
  double squares = 0, gap = 0, gap_truth = 0, darkest = 0;
  int cells = 0;
  for (int row = 1; row + 1 < rows; ++row) {
    for (int column = 0; column + 1 < columns; ++column) {
      const int i = row * columns + column;
      if (truth[i] < 0 || counts[i] == 0) continue;
      const double is = sums[i] / counts[i];
      double step = 0;  // beside edges the discs blur
      bool dark = truth[i] == 0;
      for (const int other : {i - columns, i + columns, i + 1, column > 0 ? i - 1 : i}) {
        step = std::max(step, std::abs(truth[other] - truth[i]));
        dark = dark && truth[other] == 0;
      }
      if (dark) darkest = std::max(darkest, is);
      if (column == 0 && truth[i] > 0) gap += is, gap_truth += truth[i];
      if (step > 0.15) continue;
      const double error = (is - truth[i]) / std::max(truth[i], 1.0);
      squares += error * error, ++cells;
    }
  }
  const double rms = std::sqrt(squares / cells);
  std::printf("rms %.4f of %d cells, dark %.4f, on the axis %.4f for %.4f\n", rms, cells, darkest, gap, gap_truth);
  EXPECT_GT(cells, 1500);
  constexpr double table_rms = 0.016;  // its own error
  EXPECT_LT(std::sqrt(std::max(rms * rms - table_rms * table_rms, 0.0)), 0.03);
  EXPECT_LT(darkest, 0.02);
  EXPECT_NEAR(gap, gap_truth, 0.1 * gap_truth);
}

}  // namespace
}  // namespace meniscal

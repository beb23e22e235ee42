// Menisci whose shapes are extreme, as pictures: what meniscus_solved_extremes_test.cpp asks of their meshes.
#include <glm/gtc/matrix_transform.hpp>

#include "host/world/menisci.h"
#include "tests/extremes/extremes.h"
#include "tests/unit/meniscus_shapes.h"

namespace meniscal::extremes {
namespace {

constexpr double mm = 1e-3;

void wet(Scene& scene, double contact_angle) {
  for (Material& m : scene.materials) m.contact_angle = contact_angle;
}

Object& object(Scene& scene, const std::string& name) {
  return *std::find_if(scene.objects.begin(), scene.objects.end(), [&](const Object& o) { return o.name == name; });
}

// The post's top, brought down to that height.
void cut_off(Scene& scene, double top) {
  for (glm::dvec3& p : object(scene, "post").mesh.positions) p.y = std::min(p.y, top - scene.origin.y);
}

// In place of the post, walls of 2 mm round a square of water 16 mm wide, down through the white floor.
void make_dish(Scene& scene) {
  object(scene, "post").mesh =
      shapes::moved(shapes::tray(8 * mm, 2 * mm, -60 * mm, 10 * mm), glm::translate(glm::dmat4(1), -scene.origin));
  const double reach = 9 * mm / 0.03;  // of the sheet, into the walls
  test::move(scene, "water", {reach, 1, reach}, {0, 0, 0});
}

// `least` to `most`: the highest of the contact line where it rises, the lowest where it sinks, metres.
struct Shape {
  const char* name;
  std::function<void(Scene&)> edit;
  double least, most;
  const char* warning;  // ""; there is none
};
void PrintTo(const Shape& s, std::ostream* out) { *out << s.name; }
class MeniscusShape : public testing::TestWithParam<Shape> {};

TEST_P(MeniscusShape, IsSeenByBothPaths) {
  REQUIRE_DEVICE();
  const Shape& shape = GetParam();
  RenderOptions options = test::small_options(40000, 48, 48);
  options.meniscus = MeniscusModel::exact;
  const auto edit = [&](Scene& scene) {
    shape.edit(scene);
    test::look_down_on(scene, {0, 0.02, 0}, 8 * mm);
  };
  const auto setup = test::make_setup("post", options, edit);
  const LiquidReport& liquid = setup->world.liquids.at(0);
  ASSERT_EQ(liquid.contacts.size(), 1u);
  const meniscus::Contact& line = liquid.contacts[0];
  const double rise = shape.most > 0 ? line.rise_max : line.rise_min;
  std::printf("%s: rise %.4f mm\n", shape.name, rise / mm);
  EXPECT_GT(rise, shape.least);
  EXPECT_LT(rise, shape.most);
  EXPECT_EQ(setup->world.warnings.size(), *shape.warning ? 1u : 0u);
  for (const std::string& w : setup->world.warnings) EXPECT_NE(w.find(shape.warning), std::string::npos) << w;
  const Both both = render_both(*setup, 5e-3);
  options.meniscus = MeniscusModel::none;
  const Both level = render_both(*test::make_setup("post", options, edit), 5e-3);
  std::printf("level water: %.3g off\n", relative_rms(level.cpu, both.cpu));
  EXPECT_GT(relative_rms(level.cpu, both.cpu), 0.1);
}

Shape as_high_as(double rise, const char* name, std::function<void(Scene&)> edit, const char* warning = "") {
  return {name, std::move(edit), rise - 0.01 * std::abs(rise), rise + 0.01 * std::abs(rise), warning};
}

void make_hair(Scene& scene) {
  wet(scene, 0);
  test::move(scene, "post", {0.0175, 1, 0.0175}, {0, 0, 0});
}
void fill_with_mercury(Scene& scene) {
  wet(scene, 140);
  for (Material& m : scene.materials)
    if (m.liquid) m.liquid->kind = "mercury", m.liquid->surface_tension = 0.4855, m.liquid->density = 13546;
}
void weaken_gravity(Scene& scene) {
  wet(scene, 30);
  scene.gravity /= 1000;
  test::move(scene, "water", {40, 1, 40}, {0, 0, 0});
}

// Rises round the post of 2 mm but for the hair's.
INSTANTIATE_TEST_SUITE_P(
    Rows, MeniscusShape,
    testing::Values(as_high_as(0.18076 * mm, "hair", make_hair), as_high_as(-1.148 * mm, "mercury", fill_with_mercury),
                    as_high_as(7.22 * mm, "weak_gravity", weaken_gravity),
                    as_high_as(
                        0.3 * mm, "low_post", [](Scene& s) { wet(s, 0), cut_off(s, 0.3 * mm); }, "pinned"),
                    // In its corners 1.8 times as high as at its walls, where that is 1.03 capillary lengths.
                    Shape{"square_dish", [](Scene& s) { wet(s, 30), make_dish(s); }, 1.8 * 1.03 * 2.72 * mm, 10 * mm,
                          "without bound"}),
    [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace meniscal::extremes

// The paper's figures: what menisci do to light stands where the paper shows it, and goes with them. Small pictures,
// caustics and direct light alone; masks are made from what the camera rays meet.
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "tests/support/scene_setup.h"

namespace meniscal {
namespace {

constexpr int width = 240, height = 180;

RenderOptions figure_options(MeniscusModel model) {
  RenderOptions options = test::small_options(150000, width, height);
  options.meniscus = model;
  return options;
}

// A pixel's sample: where it ends by the main camera path, and its light by all of the pixel's paths. Radiances.
struct Point {
  std::string material;  // empty: none was met
  glm::dvec3 position, normal;
  bool through_meniscus = false;
  double maps = 0, all = 0, mirrored = 0;  // of caustics; with direct light; of lamps, by specular surfaces
};
using Picture = std::vector<Point>;

void add(Picture& picture, const World& world, const Samples& samples, const View& view) {
  picture.resize(samples.pixels.size());
  for (std::size_t i = 0; i < picture.size(); ++i) {
    const shared::PixelSample& s = samples.pixels[i];
    const shared::PixelGloss g = samples.gloss.empty() ? shared::PixelGloss{} : samples.gloss[i];
    Point& point = picture[i];
    if (view.main()) {
      if (s.triangle < shared::END_FIRST) point.material = world.material_names[world.triangles[s.triangle].material];
      point.position = s.position, point.normal = s.normal;
      point.through_meniscus = s.meniscus > 0;
    }
    // A lobe shows single photons from one pixel to the next, so it counts where there is nothing else, on metal.
    const bool lambert = s.weight != glm::vec3(0);
    const glm::vec3 maps = lambert ? s.weight * (s.targeted + s.caustic) : g.targeted + g.caustic;
    const glm::vec3 direct = lambert ? s.weight * s.direct : g.direct;
    point.maps += mean_of(maps);
    point.mirrored += mean_of(s.emitted);
    if (!samples.highlights.empty()) point.mirrored += mean_of(samples.highlights[i]);
    point.all += mean_of(maps) + mean_of(direct) + mean_of(s.emitted);
  }
}

// A scene as the program renders it: photons and camera paths go where a pilot found light.
class Rendered {
 public:
  Rendered(const std::string& scene, MeniscusModel model, const std::function<void(Scene&)>& edit = {})
      : setup_(test::make_setup(scene, figure_options(model), edit)),
        gpu_(gpu::Device::open("auto"), setup_->world, setup_->settings) {
    focus(setup_->settings, figure_options(model), setup_->world, gpu_);
  }
  Picture picture() {
    Picture picture;
    gpu_.render_pass(0, [&](const Samples& samples, const View& view) { add(picture, setup_->world, samples, view); });
    return picture;
  }
  // By the same camera paths and other photons; without highlights.
  Picture by_other_photons() {
    Picture picture;
    for (const View& view : views_of(setup_->settings))
      add(picture, setup_->world, gpu_.light_camera(0, view, 1), view);
    return picture;
  }

 private:
  std::unique_ptr<test::Setup> setup_;
  GpuBackend gpu_;
};

// A figure's scene, by materials, and the least that must be seen there.
struct Figure {
  std::string scene;
  MeniscusModel model;  // exact where that is solved in seconds
  std::string floor;
  std::vector<std::string> solids;  // that show caustics
  // Light that menisci add to the part, per light that is there without them; radiance of lamps in menisci per mean
  // radiance of the floor. About half of what was found; 0: none is seen there.
  double on_floor, on_solids, on_menisci;
};
void PrintTo(const Figure& f, std::ostream* out) { *out << f.scene; }

using Part = std::function<bool(const Point&)>;
Part floor_of(const Figure& figure) {
  return [&](const Point& p) { return p.material == figure.floor && p.normal.y > 0.9; };
}
Part solids_of(const Figure& figure) {
  return [&](const Point& p) {
    return std::find(figure.solids.begin(), figure.solids.end(), p.material) != figure.solids.end();
  };
}

double mean_light(const Picture& picture, const Part& part) {
  double sum = 0, points = 0;
  for (const Point& p : picture)
    if (part(p)) sum += p.all, ++points;
  return sum / points;
}

// By pixel: light of the maps beyond that of the level liquid, per mean light of the part; nothing where the two do not
// show the same place of it.
using Pattern = std::vector<std::optional<double>>;
Pattern pattern_on(const Part& part, const Picture& picture, const Picture& level) {
  constexpr double same_place = 1e-3;  // m
  const double mean = mean_light(level, part);
  Pattern pattern(level.size());
  for (std::size_t i = 0; i < level.size(); ++i)
    if (part(level[i]) && part(picture[i]) && glm::distance(level[i].position, picture[i].position) < same_place)
      pattern[i] = (picture[i].maps - level[i].maps) / mean;
  return pattern;
}

// In the mean over its pixels. A quarter is let pass: noise, and edges of shadows that a meniscus shows in another
// place. More than 4 counts as 4: single photons that metal mirrors.
double added(const Pattern& pattern) {
  double sum = 0, points = 0;
  for (const auto& p : pattern)
    if (p) sum += std::clamp(*p, 0.25, 4.25) - 0.25, ++points;
  return sum / points;
}

// In the mean over the pixels where `menisci` shows menisci, per mean light of the floor. More than 4 counts as 4,
// which pictures show as white: the sun's disc is thousands of times as bright.
double mirrored(const Figure& figure, const Picture& picture, const Picture& menisci) {
  const double floor = mean_light(picture, floor_of(figure));
  double sum = 0, pixels = 0;
  for (std::size_t i = 0; i < picture.size(); ++i)
    if (menisci[i].through_meniscus) sum += std::min(picture[i].mirrored / floor, 4.0), ++pixels;
  return sum / pixels;
}

class Figures : public testing::TestWithParam<Figure> {};

TEST_P(Figures, MenisciLightFloorAndSolidsAndShine) {
  REQUIRE_DEVICE();
  const Figure& figure = GetParam();
  Rendered curved(figure.scene, figure.model), flat(figure.scene, MeniscusModel::none);
  const Picture menisci = curved.picture(), level = flat.picture(), again = flat.by_other_photons();

  const auto expect = [&](const char* where, double here, double none, double least) {
    if (least == 0) return;
    std::printf("%s, %s: %.4f with menisci, %.4f without\n", figure.scene.c_str(), where, here, none);
    EXPECT_GT(here, least) << where;
    EXPECT_LT(none, least / 2) << where;
  };
  for (const auto& [where, part, least] :
       {std::tuple("floor", floor_of(figure), figure.on_floor), {"solids", solids_of(figure), figure.on_solids}})
    expect(where, added(pattern_on(part, menisci, level)), added(pattern_on(part, again, level)), least);
  expect("menisci", mirrored(figure, menisci, menisci), mirrored(figure, level, menisci), figure.on_menisci);
}

const Figure sausage{"shadow_sausage", MeniscusModel::exact, "dish", {"rod"}, 0.0017, 0.0027, 0.006};
const Figure collection{"collection", MeniscusModel::paper, "dish", {}, 0.022, 0, 0.007};
INSTANTIATE_TEST_SUITE_P(
    Scenes, Figures,
    testing::Values(sausage, collection,
                    Figure{"teapot", MeniscusModel::paper, "china", {"copper"}, 0.0055, 0.0015, 0.0017},
                    Figure{"paper_clip", MeniscusModel::exact, "enamel", {}, 0.001, 0, 0.0035},
                    Figure{"two_rods", MeniscusModel::paper, "bowl", {}, 0.009, 0, 0.0017},
                    Figure{"rod_end", MeniscusModel::paper, "bowl", {"rod"}, 0.008, 0.015, 0.01},
                    Figure{"curled_hair", MeniscusModel::paper, "dish", {}, 0.009, 0, 0},
                    Figure{"hair_three_liquids", MeniscusModel::paper, "porcelain", {}, 0.008, 0, 0},
                    Figure{"glass_of_water", MeniscusModel::paper, "table", {}, 0.001, 0, 0}),
    [](const auto& tested) { return tested.param.scene; });

// Figures 12 and 13: the floor of the collection under the paper's menisci in other variants.
Pattern floor_under(const std::function<void(LiquidProperties&)>& edit, const Picture& level) {
  const auto edit_liquids = [&](Scene& scene) {
    for (Material& m : scene.materials)
      if (m.liquid) edit(*m.liquid);
  };
  return pattern_on(floor_of(collection), Rendered(collection.scene, MeniscusModel::paper, edit_liquids).picture(),
                    level);
}
Picture level_collection() { return Rendered(collection.scene, MeniscusModel::none).picture(); }

// What all but the brightest pixels, so many, stay below: where a caustic lies, however bright it is.
double limit_of(const Pattern& pattern, std::size_t brightest = 200) {
  std::vector<double> values;
  for (const auto& p : pattern)
    if (p) values.push_back(*p);
  std::nth_element(values.begin(), values.end() - brightest, values.end());
  return *(values.end() - brightest);
}

struct Agreement {
  double difference, correlation;  // of all light: RMS of the difference per RMS of the second
  double contours;                 // part of the first's brightest pixels that lie at, or beside, such of the second
};
// `shift`: the second is moved by so many pixels.
Agreement compare(const Pattern& a, const Pattern& b, int shift = 0) {
  const auto value = [](const Pattern& p, int x, int y) {
    const bool inside = x >= 0 && y >= 0 && x < width && y < height;
    return inside ? p[std::size_t(y) * width + x] : std::nullopt;
  };
  const double limit_a = limit_of(a), limit_b = limit_of(b);
  double differences = 0, first = 0, second = 0, products = 0, bright = 0, met = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto p = value(a, x, y), q = value(b, x + shift, y);
      if (!p || !q) continue;
      differences += (*p - *q) * (*p - *q);
      first += *p * *p, second += *q * *q, products += *p * *q;
      if (*p < limit_a) continue;
      bool beside = false;
      for (int i = 0; i < 9; ++i) beside |= value(b, x + shift + i % 3 - 1, y + i / 3 - 1).value_or(0) >= limit_b;
      ++bright, met += beside;
    }
  }
  return {std::sqrt(differences / second), products / std::sqrt(first * second), met / bright};
}

// "The negligible differences in the caustics are mainly gradient variations."
TEST(Figure12, ProfilesKeepTheContours) {
  REQUIRE_DEVICE();
  const Picture level = level_collection();
  const std::vector<std::string> names{"sine", "exponential", "circular", "bessel"};
  std::vector<Pattern> patterns;
  for (const std::string& name : names)
    patterns.push_back(floor_under([&](LiquidProperties& liquid) { liquid.profile = name; }, level));
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (std::size_t j = 0; j < names.size(); ++j) {
      const Agreement found = compare(patterns[i], patterns[j]), moved = compare(patterns[i], patterns[j], 4);
      std::printf("%s in %s: contours %.3f, correlation %.3f, difference %.3f; 4 pixels aside: %.3f, %.3f\n",
                  names[i].c_str(), names[j].c_str(), found.contours, found.correlation, found.difference,
                  moved.contours, moved.correlation);
      if (i == j) continue;
      EXPECT_GT(found.contours, 0.7);
      EXPECT_GT(found.correlation, 0.6);
      EXPECT_GT(found.difference, 0.05);  // they are not one and the same
      EXPECT_LT(moved.contours, 0.5);
    }
  }
}

// "The subtle differences appear more like noise."
TEST(Figure13, FlattenedMenisciKeepTheCaustic) {
  REQUIRE_DEVICE();
  const Picture level = level_collection();
  const Pattern displaced = floor_under([](LiquidProperties&) {}, level);
  const Pattern flattened = floor_under([](LiquidProperties& liquid) { liquid.flatten = true; }, level);
  const Agreement found = compare(flattened, displaced);
  std::printf("contours %.3f, correlation %.3f, difference %.3f\n", found.contours, found.correlation,
              found.difference);
  EXPECT_GT(found.contours, 0.9);
  EXPECT_GT(found.correlation, 0.9);
  EXPECT_LT(found.difference, 0.4);
  EXPECT_GT(found.difference, 0.02);
}

}  // namespace
}  // namespace meniscal

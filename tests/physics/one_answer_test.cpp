// One answer: targeted photon maps, ordinary ones with a hundred times the photons, and path tracing give the same
// picture; and none does that lacks a class of light, or has it twice.
#include <cmath>

#include "tests/support/scene_objects.h"
#include "tests/support/scene_setup.h"

namespace meniscal {
namespace {

constexpr double mm = 1e-3;

struct Case {
  std::string name, scene;
  std::function<void(Scene&)> edit;
  std::vector<std::string> classes;  // of light, that the picture has more than 2 % of
  Integrator truth;
  std::uint32_t photons, diffuse_bounces;
  double radius;  // of discs in pass 0, three times that in these passes, m: small beside a pixel, so that noise hides
                  // their blur
  std::uint32_t truth_samples;  // of a path tracer, a pixel and pass
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

// Late passes: their discs hardly shrink from one to the next, which would pass for noise.
constexpr std::uint32_t first_pass = 1000, passes = 48;
constexpr int side = 48, blocks = 12;

struct Answer {
  std::vector<double> value, variance;  // by pixel, green
};

Answer scaled(const Image& image, const std::string& layer, double factor) {
  const std::vector<float>&beauty = image.layers[0].pixels, &variance = image.find("variance")->pixels;
  Answer answer;
  for (std::size_t i = 1; i < beauty.size(); i += 3) {
    answer.value.push_back(double(beauty[i]) + (factor - 1) * double(image.find(layer)->pixels[i]));
    answer.variance.push_back(double(variance[i]));
  }
  return answer;
}

double sum(const std::vector<double>& values) {
  double total = 0;
  for (const double v : values) total += v;
  return total;
}

struct Agreement {
  double mean, chi2;  // ratio of the means; per pixel
  bool good() const { return std::abs(mean - 1) < 0.01 && std::abs(chi2 - 1) < 0.1; }
};

// Pixels that both give alike and without noise, as direct light does, tell nothing.
bool exact(double a, double b, double variance) {
  const double rounding = 1e-4 * b;
  return std::abs(a - b) <= rounding && variance <= rounding * rounding;
}

// Where a pixel happened to get few photons, its estimated variance is small, too: squares and variances are summed
// over blocks of pixels before one is divided by the other.
Agreement compare(const Answer& a, const Answer& b) {
  std::array<double, blocks * blocks> squares{}, variance{};
  for (int i = 0; i < side * side; ++i) {
    if (exact(a.value[i], b.value[i], a.variance[i] + b.variance[i])) continue;
    const int block = i / side * blocks / side * blocks + i % side * blocks / side;
    squares[block] += std::pow(a.value[i] - b.value[i], 2);
    variance[block] += a.variance[i] + b.variance[i];
  }
  double chi2 = 0;
  int count = 0;
  for (int i = 0; i < blocks * blocks; ++i)
    if (variance[i] > 0) chi2 += squares[i] / variance[i], ++count;
  // Variances are estimates, too: t^2 of two times passes - 1 degrees of freedom.
  constexpr double freedom = 2 * (passes - 1);
  return {sum(a.value) / sum(b.value), chi2 / count * (freedom - 2) / freedom};
}

Image render(const Case& c, Integrator integrator) {
  const bool path = integrator == Integrator::path;
  RenderOptions options = test::small_options(c.photons, side, side);
  options.integrator = integrator;
  if (integrator == Integrator::ordinary) options.photons = 100 * c.photons;
  options.diffuse_bounces = c.diffuse_bounces;
  options.samples = path ? c.truth_samples : 4;
  options.radius = c.radius;
  options.seed = integrator == Integrator::targeted ? 1 : 2;
  const auto setup = test::make_setup(c.scene, options, c.edit);
  const std::unique_ptr<Backend> backend = test::make_backend(!path, setup->world, setup->settings);
  focus(setup->settings, options, setup->world, *backend);
  Film film(setup->settings.crop, {"direct", "targeted", "caustic", "global", "variance"}, {});
  render_passes(*backend, {first_pass, first_pass + passes}, film, [](const Tallies&) { return true; });
  return film.image(side, side);
}

class OneAnswer : public testing::TestWithParam<Case> {};

TEST_P(OneAnswer, NeedsEveryClassOnce) {
  REQUIRE_DEVICE();
  const Case& c = GetParam();
  const Image image = render(c, Integrator::targeted);
  const Answer truth = scaled(render(c, c.truth), "direct", 1), answer = scaled(image, "direct", 1);
  const Agreement agreement = compare(answer, truth);
  std::printf("%s: mean %.4f, chi^2 %.3f; noise %.3f and %.3f\n", c.name.c_str(), agreement.mean, agreement.chi2,
              std::sqrt(sum(answer.variance) * side * side) / sum(answer.value),
              std::sqrt(sum(truth.variance) * side * side) / sum(truth.value));
  EXPECT_TRUE(agreement.good());
  for (const std::string layer : {"direct", "targeted", "caustic", "global"}) {
    SCOPED_TRACE(layer);
    const Answer without = scaled(image, layer, 0), twice = scaled(image, layer, 2);
    const bool there = std::find(c.classes.begin(), c.classes.end(), layer) != c.classes.end();
    const double part = 1 - sum(without.value) / sum(answer.value);
    std::printf("  %s: %.4f of the light\n", layer.c_str(), part);
    EXPECT_EQ(part > 0.02, there);
    if (!there) continue;
    EXPECT_FALSE(compare(without, truth).good());
    EXPECT_FALSE(compare(twice, truth).good());
  }
}

// The floor beside a post, under nothing but its meniscus. All of the view lies further from the post's foot than discs
// reach, where they lose light.
void meniscus_alone(Scene& scene) {
  test::move(scene, "floor", glm::dvec3(0.4, 1, 0.4), {0, 44 * mm, 0});
  test::move(scene, "water", glm::dvec3(5.0 / 30, 1, 5.0 / 30), {});
  test::move(scene, "lamp", glm::dvec3(4, 1, 4), {});
  test::look_down_on(scene, {3.6 * mm, -2 * mm, 0}, 1.3 * mm);
}

void glass_ball(Scene& scene) {
  std::erase_if(scene.objects, [](const Object& o) { return o.name == "water"; });
  for (Material& m : scene.materials)
    if (m.name == "sphere") m.metallic = m.roughness = 0, m.transmission = 1, m.base_color = glm::dvec3(1), m.ior = 1.5;
  test::move(scene, "floor", glm::dvec3(0.25, 1, 0.25), {0, 10 * mm, 0});
  test::look_down_on(scene, {0, -7 * mm, 0}, 6 * mm);
}

// A lamp as wide as the room, which paths find soon.
void wide_lamp(Scene& scene) { test::move(scene, "lamp", {1.8, 1, 1.8}, {}); }

// The table in the light that has come through the beaker, its water and its rod; and what is seen of that through
// them.
void beside_beaker(Scene& scene) {
  std::erase_if(scene.objects, [](const Object& o) { return o.name == "lamp"; });
  test::move(scene, "table", {0.2, 1, 0.2}, {});
  test::look_down_on(scene, {38 * mm, 90 * mm, 20 * mm}, 22 * mm);
}

// A post in a puddle before a mirror, under a slanted sun.
void mirror(Scene& scene) {
  scene.lights[0].direction = glm::normalize(glm::dvec3(1, -2, 0.3));
  test::move(scene, "floor", glm::dvec3(0.3, 1, 0.3), {0, 46 * mm, 0});
  test::move(scene, "water", glm::dvec3(6.0 / 30, 1, 6.0 / 30), {});
  Material silver;
  silver.name = "silver";
  silver.metallic = 1, silver.roughness = 0;
  silver.base_color = glm::dvec3(0.9);
  scene.materials.push_back(silver);
  scene.objects.push_back(test::make_box("mirror", static_cast<int>(scene.materials.size()) - 1,
                                         glm::dvec3(4.5 * mm, -5 * mm, -5 * mm) - scene.origin,
                                         glm::dvec3(5.5 * mm, 8 * mm, 5 * mm) - scene.origin));
  test::look_down_on(scene, {0, -2 * mm, 0}, 7 * mm);
}

using Classes = std::vector<std::string>;
const Classes all{"direct", "targeted", "caustic", "global"};

std::string name_of(const testing::TestParamInfo<Case>& tested) { return tested.param.name; }

INSTANTIATE_TEST_SUITE_P(
    Scenes, OneAnswer,
    testing::Values(
        Case{"meniscus", "area_light", meniscus_alone, {"direct", "targeted"}, Integrator::path, 8000, 0, 0.2 * mm, 16},
        Case{"glass", "sphere", glass_ball, {"direct", "caustic"}, Integrator::ordinary, 1000, 0, 0.45 * mm, 0},
        Case{"tank", "tank", wide_lamp, all, Integrator::path, 8000, 2, 1.5 * mm, 16},
        Case{"mirror", "post", mirror, {"direct", "targeted", "caustic"}, Integrator::ordinary, 1000, 0, 0.8 * mm, 0}),
    name_of);
const Case beaker{"beaker", "beaker", beside_beaker, all, Integrator::ordinary, 4000, 1, 3 * mm, 0};
INSTANTIATE_TEST_SUITE_P(Slow, OneAnswer, testing::Values(beaker), name_of);

}  // namespace
}  // namespace meniscal

// Lights at any distance, of any size and intensity, against closed forms.
#include <glm/gtc/constants.hpp>

#include "tests/extremes/extremes.h"

namespace meniscal::extremes {
namespace {

RenderOptions floor_options() { return test::small_options(1000, 32, 32); }

// Radiance of the white floor per what it should be, in the mean and at the worst pixel.
struct Ratio {
  double mean = 0, least = 1e30, most = 0;
};
Ratio ratio(const Picture& picture, const Picture& positions,
            const std::function<double(const glm::dvec3&)>& irradiance) {
  Ratio r;
  for (std::size_t i = 0; i < picture.size(); ++i) {
    const double here = picture[i].x * glm::pi<double>() / irradiance(positions[i]);
    r.mean += here / double(picture.size());
    r.least = std::min(r.least, here), r.most = std::max(r.most, here);
  }
  return r;
}
// `rounding`: beside these, what single precision costs the GPU.
void expect_light(const test::Setup& setup, const std::function<double(const glm::dvec3&)>& irradiance, double mean,
                  double worst, double rounding = 0) {
  const Both both = render_both(setup, 1e-3 + rounding);
  for (const bool gpu : {false, true}) {
    const Ratio found = ratio(gpu ? both.gpu : both.cpu, both.positions, irradiance);
    const double more = gpu ? rounding : 0;
    EXPECT_NEAR(found.mean, 1, mean + more);
    EXPECT_GT(found.least, 1 - worst - more);
    EXPECT_LT(found.most, 1 + worst + more);
  }
}

class LightDistance : public testing::TestWithParam<double> {};

TEST_P(LightDistance, FollowsTheInverseSquare) {
  REQUIRE_DEVICE();
  const double h = GetParam(), seen = std::min(3 * h, 0.5);
  const auto setup = test::make_setup("post", floor_options(), [&](Scene& scene) {
    make_floor(scene, 1, seen);
    scene.lights = {point_light({0, h, 0}, 1)};
  });
  // Points of the floor are off by as much as its corners' coordinates are rounded, on each axis.
  const double rounding = 4 * double(std::numeric_limits<float>::epsilon()) / h;
  expect_light(
      *setup, [&](const glm::dvec3& p) { return h / std::pow(h * h + p.x * p.x + p.z * p.z, 1.5); }, 1e-3, 1e-2,
      rounding);
}
INSTANTIATE_TEST_SUITE_P(Metres, LightDistance, testing::Values(1e-6, 1e-4, 1e-2, 1.0, 1e3, 1e6, 1e9));

constexpr double lamp_height = 0.1;

// A square lamp face to face with the middle of the floor, 10 cm above it, that reflects nothing.
std::unique_ptr<test::Setup> under_lamp(double size, const RenderOptions& options, double roughness, double metallic) {
  return test::make_setup("post", options, [&](Scene& scene) {
    make_floor(scene, 0.5, 1e-3);
    if (metallic > 0) scene.materials[0].metallic = metallic, scene.materials[0].roughness = roughness;
    Material lamp;
    lamp.name = "lamp";
    lamp.emission = glm::dvec3(1);
    lamp.base_color = glm::dvec3(0);
    scene.materials.push_back(lamp);
    Object square;
    square.name = "lamp", square.material = 1;
    const double a = 0.5 * size, h = lamp_height;
    square.mesh.positions = {{-a, h, -a}, {a, h, -a}, {a, h, a}, {-a, h, a}};
    square.mesh.normals.assign(4, {0, -1, 0});
    square.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.objects.push_back(square);
    test::look_down_on(scene, {0, 0.5 * h, 0}, 1e-3);
  });
}

class LightSize : public testing::TestWithParam<double> {};

TEST_P(LightSize, FollowsTheFormFactor) {
  REQUIRE_DEVICE();
  const double size = GetParam();
  RenderOptions options = floor_options();
  options.samples = 16;
  const auto setup = under_lamp(size, options, 1, 0);
  // Of four quarters, each seen from below its corner (Howell, configuration factor B-3).
  const double x = 0.5 * size / lamp_height, y = x / std::sqrt(1 + x * x);
  const double irradiance = 4 * y * std::atan(y);
  if (size == 0) {
    EXPECT_TRUE(setup->world.lights.empty());
    return;
  }
  expect_light(
      *setup, [&](const glm::dvec3&) { return irradiance; }, 2e-2, 1);
}
INSTANTIATE_TEST_SUITE_P(Metres, LightSize, testing::Values(0.0, 1e-6, 1e-3, 0.1, 10.0, 1e3));

// Shadow rays and lobes share such a lamp's light out alike on both paths, and it is that of a sky.
TEST(WideLamp, ShinesOnRoughMetal) {
  REQUIRE_DEVICE();
  RenderOptions options = floor_options();
  options.samples = 16, options.diffuse_bounces = 1;
  std::vector<double> means;
  for (const double size : {10.0, 1e3}) {
    const Both both = render_both(*under_lamp(size, options, 0.5, 1));
    for (const Picture& picture : {both.cpu, both.gpu}) {
      means.push_back(0);
      for (const glm::dvec3& radiance : picture) means.back() += radiance.x / double(picture.size());
    }
  }
  std::printf("radiance %.4f and %.4f\n", means[0], means[2]);
  EXPECT_GT(means[0], 0.5);
  for (const double mean : means) EXPECT_NEAR(mean, means[0], 0.02 * means[0]);
}

class Intensity : public testing::TestWithParam<double> {};

TEST_P(Intensity, ScalesThePicture) {
  REQUIRE_DEVICE();
  for (const char* name : {"post", "tank"}) {
    const RenderOptions options = test::small_options(20000, 48, 36);
    const auto dimmed = [](double factor) {
      return [=](Scene& scene) {
        for (PunctualLight& l : scene.lights) l.intensity *= factor;
        for (Material& m : scene.materials) m.emission *= factor;
      };
    };
    const Both usual = render_both(*test::make_setup(name, options));
    const Both other = render_both(*test::make_setup(name, options, dimmed(GetParam())));
    EXPECT_LT(relative_rms(scaled(other.cpu, 1 / GetParam()), usual.cpu), 1e-5) << name;
    EXPECT_LT(relative_rms(scaled(other.gpu, 1 / GetParam()), usual.gpu), 1e-3) << name;
  }
}
INSTANTIATE_TEST_SUITE_P(Factors, Intensity, testing::Values(1e-20, 1e-10, 1e10, 1e20));

}  // namespace
}  // namespace meniscal::extremes

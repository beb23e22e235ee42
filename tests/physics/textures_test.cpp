// Textures against closed forms and quadrature: what a surface reflects, where its normal points, what it emits.
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "host/reference/emission.h"
#include "host/reference/materials.h"
#include "tests/support/textured_scene.h"

namespace meniscal {
namespace {

constexpr double pi = glm::pi<double>();

// Of the GPU and of the reference path: the samples of one pass.
std::array<std::vector<shared::PixelSample>, 2> samples_of(const test::Setup& setup, std::uint32_t pass) {
  GpuBackend gpu(gpu::Device::open("auto", true), setup.world, setup.settings);
  reference::ReferenceBackend cpu(setup.world, setup.settings);
  return {test::render_pass(gpu, pass).samples, test::render_pass(cpu, pass).samples};
}

RenderOptions options_without_photons(int size) {
  RenderOptions options = test::small_options(0, size, size);
  options.radius = 1e-3;  // samples then tell where their rays ended
  return options;
}

double linear(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

// A floor of 2 m that repeats three texels by two four times each way, in the sun: albedo / pi times irradiance.
TEST(TexturedFloor, ReflectsItsAlbedo) {
  REQUIRE_DEVICE();
  const double encoded[2][3] = {{10, 250, 60}, {128, 0, 200}};  // rows
  const auto image = test::make_image(3, 2, false, [&](std::uint32_t x, std::uint32_t y) {
    return glm::uvec4(encoded[y][x], 255 - encoded[y][x], 77, 255);
  });
  Scene scene;
  scene.materials = {test::make_matte("floor")};
  scene.materials[0].base_color = glm::dvec3(0.5, 1, 0.25);
  scene.materials[0].base_color_texture = test::make_texture(image, true);
  scene.materials[0].base_color_texture->row = {glm::dvec3(4, 0, 0), glm::dvec3(0, 4, 0)};
  scene.objects = {test::make_quad("floor", {-1, 0, -1}, {2, 0, 0}, {0, 0, 2}, 0)};
  scene.cameras = {test::camera_above(glm::dvec3(0), 2)};
  scene.lights = {test::sunlight({1, 2, 0})};
  const auto setup = test::make_setup(scene, options_without_photons(60));

  const auto texel = [&](double x, double y) {
    const double e = encoded[((int(y) % 2) + 2) % 2][((int(x) % 3) + 3) % 3];
    return glm::dvec3(linear(e / 255), linear((255 - e) / 255), linear(77 / 255.0));
  };
  for (const auto& samples : samples_of(*setup, 1))
    for (const shared::PixelSample& s : samples) {
      ASSERT_LT(s.triangle, shared::END_FIRST);
      const double x = 6 * (double(s.position.x) + 1) - 0.5, y = 4 * (double(s.position.z) + 1) - 0.5;
      const double left = std::floor(x), top = std::floor(y);
      glm::dvec3 albedo = glm::mix(glm::mix(texel(left, top), texel(left + 1, top), x - left),
                                   glm::mix(texel(left, top + 1), texel(left + 1, top + 1), x - left), y - top);
      albedo *= glm::dvec3(0.5, 1, 0.25);
      const glm::dvec3 expected = albedo / pi * (2 / std::sqrt(5.0));
      EXPECT_LT(glm::distance(glm::dvec3(s.weight) * glm::dvec3(s.direct), expected), 1e-5) << s.position.x;
    }
}

// The same normal everywhere, told by a texture in several ways; the sun from four sides tells where it points.
struct Tilt {
  const char* name;
  glm::dvec3 told;    // along the image's right, up and out of it
  glm::dvec3 normal;  // on the floor, where +X is the image's right and +Z its lower side
  std::array<glm::dvec3, 2> row{glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)};
  double scale = 1;
};
void PrintTo(const Tilt& t, std::ostream* out) { *out << t.name; }

class NormalMap : public testing::TestWithParam<Tilt> {};

TEST_P(NormalMap, TurnsTheNormal) {
  REQUIRE_DEVICE();
  const Tilt& tilt = GetParam();
  const auto image = test::make_image(2, 2, true, [&](std::uint32_t, std::uint32_t) {
    return glm::uvec4(glm::round((tilt.told / glm::dvec3(tilt.scale, tilt.scale, 1) * 0.5 + 0.5) * 65535.0), 65535);
  });
  for (const glm::dvec3& towards :
       {glm::dvec3(1, 1, 0), glm::dvec3(-1, 1, 0), glm::dvec3(0, 1, 1), glm::dvec3(0, 1, -1)}) {
    Scene scene;
    scene.materials = {test::make_matte("floor")};
    scene.materials[0].normal_texture = test::make_texture(image, false);
    scene.materials[0].normal_texture->row = tilt.row;
    scene.materials[0].normal_scale = tilt.scale;
    scene.objects = {test::make_quad("floor", {-1, 0, -1}, {2, 0, 0}, {0, 0, 2}, 0)};
    scene.cameras = {test::camera_above(glm::dvec3(0), 1.8)};
    scene.lights = {test::sunlight(towards)};
    const auto setup = test::make_setup(scene, options_without_photons(6));
    const double expected = std::max(glm::dot(tilt.normal, glm::normalize(towards)), 0.0);
    for (const auto& samples : samples_of(*setup, 0))
      for (const shared::PixelSample& s : samples)
        EXPECT_NEAR(double(s.direct.x), expected, 1e-4) << towards.x << " " << towards.z;
  }
}

constexpr double c20 = 0.93969262078590843, s20 = 0.34202014332566871;
INSTANTIATE_TEST_SUITE_P(
    Ways, NormalMap,
    testing::Values(Tilt{"level", {0, 0, 1}, {0, 1, 0}}, Tilt{"right", {s20, 0, c20}, {s20, c20, 0}},
                    Tilt{"up", {0, s20, c20}, {0, c20, -s20}},
                    Tilt{"mirrored", {s20, 0, c20}, {-s20, c20, 0}, {glm::dvec3(-1, 0, 1), glm::dvec3(0, 1, 0)}},
                    Tilt{"mirrored_up", {0, s20, c20}, {0, c20, -s20}, {glm::dvec3(-1, 0, 1), glm::dvec3(0, 1, 0)}},
                    // The image's right is the floor's -Z.
                    Tilt{"turned", {s20, 0, c20}, {0, c20, -s20}, {glm::dvec3(0, -1, 0), glm::dvec3(1, 0, 0)}},
                    Tilt{"scaled", {s20, 0, c20}, {s20, c20, 0}, {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)}, 2},
                    // No coordinates to speak of: left alone.
                    Tilt{"degenerate", {s20, 0, c20}, {0, 1, 0}, {glm::dvec3(1, 1, 0), glm::dvec3(1, 1, 0)}},
                    // Below the facet: just above it.
                    Tilt{"below", {1, 0, 0}, {0.99995, 0.0099995, 0}}),
    [](const auto& tested) { return std::string(tested.param.name); });

// What a surface is where its metallic-roughness texture has these texels (roughness in green, metallic in blue), of
// 255.
shared::Surface surface_with(double metallic, double roughness, glm::uvec2 there, glm::uvec2 elsewhere) {
  const auto image = test::make_image(2, 1, false, [&](std::uint32_t x, std::uint32_t) {
    const glm::uvec2 told = x == 0 ? there : elsewhere;
    return glm::uvec4(9, told.x, told.y, 255);
  });
  Scene scene;
  scene.materials = {test::make_matte("plate")};
  Material& m = scene.materials[0];
  m.base_color = glm::dvec3(0.8, 0.6, 0.4);
  m.metallic = metallic;
  m.roughness = roughness;
  m.metallic_roughness_texture = test::make_texture(image, false);
  m.most_roughness = std::max(there.x, elsewhere.x) / 255.0;
  m.most_metallic = std::max(there.y, elsewhere.y) / 255.0;
  scene.objects = {test::make_quad("plate", {-1, 0, -1}, {2, 0, 0}, {0, 0, 2}, 0)};
  scene.cameras = {test::camera_above(glm::dvec3(0), 1)};
  const World world = build_world(scene, MeniscusModel::none);
  // In the first triangle, at the left texel's centre.
  for (std::uint32_t i = 0; i < 2; ++i) {
    reference::Hit hit{1, i, glm::dvec3(-0.5, 0, 0.5), glm::dvec3(0, 1, 0)};
    if (world.triangles[i].corner[1].x < 0) return reference::shade(world, hit);
  }
  throw std::logic_error("no such triangle");
}

TEST(MetallicRoughness, FactorsMultiplyAndTheClassStays) {
  // Rough: alpha is the product's square, f0 between a dielectric's and the base colour.
  shared::Surface s = surface_with(0.5, 0.8, {128, 51}, {255, 255});
  EXPECT_EQ(s.specular, 0);
  EXPECT_NEAR(double(s.alpha), std::pow(0.8 * 128 / 255, 2), 1e-6);
  EXPECT_NEAR(double(s.f0.y), glm::mix(0.04, 0.6, 0.5 * 0.2), 1e-6);
  EXPECT_NEAR(double(s.albedo.z), 0.4 * (1 - 0.5 * 0.2), 1e-6);
  // A smooth place of a rough material stays rough, if only just.
  s = surface_with(0.5, 0.8, {0, 51}, {255, 255});
  EXPECT_EQ(s.specular, 0);
  EXPECT_NEAR(double(s.alpha), 0.05 * 0.05, 1e-8);
  // Smooth all over, though the factor alone is not: a mirror, as much as it is metal.
  s = surface_with(1, 0.8, {10, 51}, {0, 255});
  EXPECT_EQ(s.kind, shared::SPECULAR_MIRROR);
  EXPECT_EQ(s.alpha, 0);
  EXPECT_NEAR(double(s.f0.y), glm::mix(0.04, 0.6, 0.2), 1e-6);
  EXPECT_NEAR(double(s.albedo.z), 0.4 * (1 - 0.2), 1e-6);
}

// Texels of a lamp, of which the left half is dark.
glm::uvec4 lamp_texel(std::uint32_t x, std::uint32_t y) {
  return x < 4 ? glm::uvec4(0) : (x + y) % 2 == 0 ? glm::uvec4(255, 40, 0, 255) : glm::uvec4(0, 120, 255, 255);
}

Scene scene_with_lamp() {
  Scene scene;
  scene.materials = {test::make_matte("floor"), test::make_matte("lamp")};
  scene.materials[1].emission = glm::dvec3(2, 3, 4);
  scene.materials[1].base_color = glm::dvec3(0);
  scene.materials[1].emissive_texture = test::make_texture(test::make_image(8, 4, false, lamp_texel), true, true);
  scene.objects = {test::make_quad("floor", {-1, 0, -1}, {2, 0, 0}, {0, 0, 2}, 0),
                   test::make_quad("lamp", {0.5, 0.6, -0.3}, {-0.8, 0, 0}, {0, 0, 0.6}, 1)};
  return scene;
}

// What reaches a point of the floor from the lamp, by quadrature.
glm::dvec3 irradiance_of_lamp(const glm::dvec3& point) {
  constexpr int n = 800;
  glm::dvec3 sum(0);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double u = (i + 0.5) / n, v = (j + 0.5) / n;
      const glm::uvec4 encoded = lamp_texel(std::uint32_t(8 * u), std::uint32_t(4 * v));
      const glm::dvec3 way = glm::dvec3(0.5 - 0.8 * u, 0.6, -0.3 + 0.6 * v) - point;
      const double distance2 = glm::dot(way, way), cosine = way.y / std::sqrt(distance2);
      for (int c = 0; c < 3; ++c) sum[c] += linear(encoded[c] / 255.0) * cosine * cosine / distance2;
    }
  return glm::dvec3(2, 3, 4) * sum * (0.8 * 0.6 / (n * n));
}

TEST(TexturedLamp, LightsAsQuadratureSays) {
  REQUIRE_DEVICE();
  for (const glm::dvec3& point : {glm::dvec3(-0.2, 0, -0.1), glm::dvec3(0.45, 0, 0.3)}) {
    Scene scene = scene_with_lamp();
    scene.cameras = {test::camera_above(point, 1e-4)};
    const auto setup = test::make_setup(scene, options_without_photons(128));
    const glm::dvec3 expected = irradiance_of_lamp(point);
    for (const auto& samples : samples_of(*setup, 0)) {
      glm::dvec3 sum(0);
      for (const shared::PixelSample& s : samples) sum += glm::dvec3(s.direct);
      sum /= double(samples.size());
      std::printf("irradiance %.5f %.5f %.5f, expected %.5f %.5f %.5f\n", sum.x, sum.y, sum.z, expected.x, expected.y,
                  expected.z);
      EXPECT_LT(glm::length(sum / expected - 1.0), 0.03);
    }
  }
}

// Each half of the lamp's triangles gets the probability that its part of the pattern is worth; a dark one is no light.
TEST(TexturedLamp, IsChosenByItsMean) {
  Scene scene = scene_with_lamp();
  scene.cameras = {test::camera_above(glm::dvec3(0), 1)};
  auto image = test::make_image(2, 2, false, [](std::uint32_t x, std::uint32_t) { return glm::uvec4(x * 255); });
  // By the first triangle's own coordinates alone: it sees the dark column only.
  scene.materials[1].emissive_texture = test::make_texture(image, true, true);
  scene.objects[1].coordinates[0].fill(glm::vec4(0.25f));
  World world = build_world(scene, MeniscusModel::none);
  ASSERT_EQ(world.lights.size(), 1u);
  EXPECT_EQ(world.lights[0].probability, 1);
  // The second sees the border: the bright column is right of the diagonal's middle, three quarters of its area.
  scene.objects[1].coordinates[0].fill(glm::vec4(0.75f));
  world = build_world(scene, MeniscusModel::none);
  ASSERT_EQ(world.lights.size(), 2u);
  const double low = std::min(double(world.lights[0].probability), double(world.lights[1].probability));
  EXPECT_NEAR(low, 0.75 / 1.75, 0.02);
}

TEST(TexturedLamp, EmitsItsPower) {
  Scene scene = scene_with_lamp();
  scene.cameras = {test::camera_above(glm::dvec3(0), 1)};
  const World world = build_world(scene, MeniscusModel::none);
  const reference::Tracer tracer(world);
  constexpr std::uint32_t photons = 20000;
  glm::dvec3 sum(0);
  for (std::uint32_t i = 0; i < photons; ++i) {
    const reference::Emission emission = reference::emit(tracer, {0.5, 0.5}, {1, 0, 0, i});
    if (emission.ray.origin.x > 0.1001) {
      EXPECT_EQ(emission.flux, glm::dvec3(0));
    }
    sum += emission.flux;
  }
  // Of eight texels four are dark, two red and two blue.
  const glm::dvec3 mean = (glm::dvec3(1, linear(40 / 255.0), 0) + glm::dvec3(0, linear(120 / 255.0), 1)) / 4.0;
  const glm::dvec3 expected = pi * 0.8 * 0.6 * glm::dvec3(2, 3, 4) * mean;
  EXPECT_LT(glm::length(sum / double(photons) / expected - 1.0), 0.03);
}

// Photons from the lamp, gathered as interreflection, and paths that find it: one answer.
TEST(TexturedLamp, EmitsPhotonsAsPathsSee) {
  REQUIRE_DEVICE();
  Scene scene = scene_with_lamp();
  scene.materials[0].base_color_texture = test::make_texture(
      test::make_image(2, 2, false,
                       [](std::uint32_t x, std::uint32_t y) { return glm::uvec4(250, x == y ? 250 : 90, 90, 255); }),
      true);
  scene.objects.push_back(test::make_quad("wall", {-1, 0.55, -1}, {2, 0, 0}, {0, -0.55, 0}, 0));
  scene.cameras = {test::camera_above({0.1, -0.2, 0}, 1.9)};
  RenderOptions options = test::small_options(200000, 32, 32);
  options.diffuse_bounces = 2;
  const auto mean_by = [&](Integrator integrator, std::uint32_t samples) {
    options.integrator = integrator;
    options.samples = samples;
    const auto setup = test::make_setup(scene, options);
    const std::unique_ptr<Backend> backend =
        test::make_backend(integrator != Integrator::path, setup->world, setup->settings);
    Film film(setup->settings.crop, {}, {});
    render_passes(*backend, {0, 4}, film, [](const Tallies&) { return true; });
    const Image image = film.image(32, 32);
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < image.layers[0].pixels.size(); ++i)
      sum[int(i % 3)] += double(image.layers[0].pixels[i]);
    return sum;
  };
  const glm::dvec3 paths = mean_by(Integrator::path, 256), photons = mean_by(Integrator::targeted, 16);
  std::printf("photons / paths: %.4f %.4f %.4f\n", photons.x / paths.x, photons.y / paths.y, photons.z / paths.z);
  EXPECT_LT(glm::length(photons / paths - 1.0), 0.03);
}

}  // namespace
}  // namespace meniscal

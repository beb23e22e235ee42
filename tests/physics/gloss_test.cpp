// Outer faces under skies and suns, against closed forms: whichever paths find the light, it is the same.
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "host/reference/reflection.h"
#include "tests/support/scene_setup.h"
#include "tests/support/skies.h"

namespace meniscal {
namespace {

using glm::dvec3;

struct Finish {
  const char* name;
  double roughness, metallic, albedo;
};
struct Paths {
  const char* name;
  Quality quality;
  std::uint32_t diffuse_bounces;  // 0: the lights alone are asked
};

class Gloss : public testing::TestWithParam<std::tuple<Finish, Paths>> {};

std::unique_ptr<test::Setup> make_floor(const Finish& finish, const Paths& paths, const Environment& sky) {
  RenderOptions options = test::small_options(1000, 32, 32);
  options.quality = paths.quality;
  options.samples = 8;
  options.diffuse_bounces = paths.diffuse_bounces;
  return test::make_setup("flat_water", options, [&](Scene& scene) {
    std::erase_if(scene.objects, [](const Object& o) { return o.name != "floor"; });
    for (Material& m : scene.materials) {
      m.base_color = dvec3(finish.albedo);
      m.metallic = finish.metallic;
      m.roughness = finish.roughness;
      m.specular = 1;
    }
    test::light_by(scene, sky);
  });
}

// What the floor, seen straight on, reflects of light from all round: by the lobe, by its samples' mean; and below.
double reflected(const World& world) {
  const auto floor = std::max_element(world.surfaces.begin(), world.surfaces.end(),
                                      [](const auto& a, const auto& b) { return a.f90 < b.f90; });
  const reference::Face face{dvec3(0, 1, 0), dvec3(0, 1, 0), double(floor->alpha), dvec3(floor->f0),
                             double(floor->f90)};
  double lobe = 0;
  constexpr int side = 400;
  for (int i = 0; i < side * side && face.alpha > 0; ++i)
    lobe += reference::sample_lobe(face, {(i % side + 0.5) / side, (double(i / side) + 0.5) / side}).weight.x;
  const double face_alone = double(floor->f0.x);
  return (face.alpha > 0 ? lobe / side / side : face_alone) + (1 - face_alone) * double(floor->albedo.x);
}

TEST_P(Gloss, IsThatOfAUniformSky) {
  REQUIRE_DEVICE();
  const auto& [finish, paths] = GetParam();
  const auto setup = make_floor(finish, paths, test::make_sky(32, 16, [](int, int) { return glm::vec3(1); }));
  GpuBackend gpu(gpu::Device::open("auto"), setup->world, setup->settings);
  Film film(setup->settings.crop, {}, {});
  render_passes(gpu, {0, 64}, film, [](const Tallies&) { return true; });
  const Image image = film.image(32, 32);
  double mean = 0;
  for (const float v : image.layers[0].pixels) mean += double(v) / (3 * 32 * 32);
  const double expected = reflected(setup->world);
  std::printf("radiance %.5f, expected %.5f\n", mean, expected);
  EXPECT_NEAR(mean, expected, 0.01 * expected);
}

INSTANTIATE_TEST_SUITE_P(
    Finishes, Gloss,
    testing::Combine(testing::Values(Finish{"lacquer", 0, 0, 1}, Finish{"plastic", 0.4, 0, 0.5},
                                     Finish{"brushed", 0.6, 1, 0.9}, Finish{"alloy", 0.5, 0.5, 0.8}),
                     testing::Values(Paths{"asked", Quality::draft, 0}, Paths{"followed", Quality::draft, 2},
                                     Paths{"gathered", Quality::final, 2})),
    [](const auto& tested) {
      return std::string(std::get<0>(tested.param).name) + "_" + std::get<1>(tested.param).name;
    });

}  // namespace
}  // namespace meniscal

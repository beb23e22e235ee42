// Footprints are as wide as the light allows that a view shows.
#include "host/render/widening.h"

#include "host/render/pilot.h"
#include "tests/support/scene_objects.h"
#include "tests/support/scene_setup.h"

namespace meniscal {
namespace {

double widening(const test::Setup& setup, bool on_gpu) {
  const std::unique_ptr<Backend> backend = test::make_backend(on_gpu, setup.world, setup.settings);
  const Pilot pilot = look_ahead(*backend, setup.world, setup.settings);
  return find_widening(*backend, setup.world, setup.settings, pilot.starts, setup.settings.photons);
}

// The bright edge that a post's meniscus throws, and soft shadows.
TEST(Widening, IsMoreForSoftLightThanForFolds) {
  REQUIRE_DEVICE();
  const auto fold_of = [](const RenderOptions& options) {
    return test::make_setup("post", options, [](Scene& scene) {
      for (Material& m : scene.materials) m.contact_angle = 120;
      test::look_down_on(scene, {5.8e-3, 0.04, 0}, 4e-3);
    });
  };
  const RenderOptions large = test::small_options(200000, 480, 360);
  const double soft = widening(*test::make_setup("area_light", large), true), fold = widening(*fold_of(large), true);
  std::printf("soft %.3f, fold %.3f\n", soft, fold);
  EXPECT_LE(soft, 2.8);
  EXPECT_GE(fold, 1);
  EXPECT_GT(soft, 1.4 * fold);
  const auto small = test::make_setup("area_light", test::small_options(40000, 64, 48));
  EXPECT_EQ(widening(*small, false), widening(*small, true)) << "the reference path decides alike";
}

}  // namespace
}  // namespace meniscal

// The shaders' traversal against the reference path's, where its stack gets deep.
#include <random>

#include "tests/support/gpu_rays.h"
#include "tests/support/scene_setup.h"

namespace meniscal {
namespace {

// Triangles that overlap all over the scene: rays meet nearly every box.
Scene hay(std::size_t triangles) {
  Scene scene;
  scene.file = "hay";
  scene.materials.emplace_back();
  scene.cameras.emplace_back();
  std::mt19937 random(5);
  const auto unit = [&] { return double(random()) / 4294967296.0 - 0.5; };
  Object object;
  for (std::size_t i = 0; i < 3 * triangles; ++i) {
    object.mesh.positions.push_back({unit(), unit(), unit()});
    object.mesh.normals.push_back({0, 1, 0});
  }
  for (std::uint32_t i = 0; i < triangles; ++i) object.mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  scene.objects.push_back(object);
  return scene;
}

TEST(Traversal, KeepsWhatItsRegistersCannotHold) {
  REQUIRE_DEVICE();
  const World world = build_world(hay(5000), MeniscusModel::none);
  std::mt19937 random(6);
  const auto unit = [&] { return float(random()) / 4294967296.0f - 0.5f; };
  std::vector<test::Ray> rays;
  for (int i = 0; i < 4000; ++i) {
    const glm::vec3 from(unit(), unit(), unit()), to(unit(), unit(), unit());
    // Towards the middle and just past it, from far: much is met before the nearest is known.
    rays.push_back({2.0f * from, test::no_triangle, glm::normalize(to - 2.0f * from), 1e30f});
  }
  const gpu::Device device = gpu::Device::open("auto", true);
  test::GpuRays gpu(device, world, rays);
  gpu.intersect();
  const auto hits = gpu.hits();
  const reference::Tracer tracer(world);
  std::size_t differ = 0, hit = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto expected =
        tracer.closest({glm::dvec3(rays[i].origin), glm::dvec3(rays[i].direction)}, 1e30, test::no_triangle);
    hit += expected.has_value();
    differ += hits[i].triangle != (expected ? expected->triangle : test::no_triangle);
    if (expected && hits[i].triangle == expected->triangle) {
      EXPECT_NEAR(double(hits[i].t), expected->t, 1e-5) << "ray " << i;
    }
  }
  EXPECT_GT(hit, rays.size() / 2);
  EXPECT_LE(differ, rays.size() / 500) << "beyond what rounding beside edges explains";
  EXPECT_TRUE(device.validation_messages().empty());
}

}  // namespace
}  // namespace meniscal

// CPU and GPU must agree on where the members of the shared structs lie.
#include "host/gpu/commands.h"
#include "layout_test_spirv.h"
#include "shaders/shared/structs.h"
#include "shaders/shared/textures.h"
#include "tests/support/scene_setup.h"

namespace meniscal {
namespace {

TEST(Layout, SharedStructsLieAlikeOnBothSides) {
  REQUIRE_DEVICE();
  const gpu::Device device = gpu::Device::open("auto", true);
  const gpu::ComputePass pass(device, "layout", layout_test_spirv,
                              {{0, gpu::Kind::storage},
                               {1, gpu::Kind::storage},
                               {2, gpu::Kind::storage},
                               {3, gpu::Kind::storage},
                               {4, gpu::Kind::storage},
                               {5, gpu::Kind::storage},
                               {6, gpu::Kind::storage}});
  const gpu::Buffer surfaces(device, "a", 2 * sizeof(shared::Surface)), lights(device, "b", 2 * sizeof(shared::Light)),
      ends(device, "c", 2 * sizeof(shared::PhotonEnd)), discs(device, "d", 2 * sizeof(shared::PhotonDisc)),
      samples(device, "e", 2 * sizeof(shared::PixelSample)),
      materials(device, "f", 2 * sizeof(shared::MaterialTextures)), textures(device, "g", 2 * sizeof(shared::Texture));
  const gpu::BindingSet bound =
      pass.bind({{0, surfaces}, {1, lights}, {2, ends}, {3, discs}, {4, samples}, {5, materials}, {6, textures}});
  gpu::Commands commands(device);
  commands.dispatch(pass, bound, 1);
  commands.submit_and_wait();

  using glm::vec3;
  const auto surface = surfaces.download<shared::Surface>()[1];
  EXPECT_EQ(surface.albedo, vec3(1, 2, 3));
  EXPECT_EQ(surface.specular, 4);
  EXPECT_EQ(surface.tint, vec3(5, 6, 7));
  EXPECT_EQ(surface.ior, 8);
  EXPECT_EQ(surface.absorption, vec3(9, 10, 11));
  EXPECT_EQ(surface.kind, 12u);
  EXPECT_EQ(surface.emission, vec3(13, 14, 15));
  EXPECT_EQ(surface.double_sided, 16u);
  EXPECT_EQ(surface.rank, 17u);
  EXPECT_EQ(surface.liquid, 18u);
  EXPECT_EQ(surface.alpha, 19);
  EXPECT_EQ(surface.textures, 20u);
  EXPECT_EQ(surface.f0, vec3(21, 22, 23));
  EXPECT_EQ(surface.f90, 24);
  const auto light = lights.download<shared::Light>()[1];
  EXPECT_EQ(light.position, vec3(1, 2, 3));
  EXPECT_EQ(light.type, 4u);
  EXPECT_EQ(light.direction, vec3(5, 6, 7));
  EXPECT_EQ(light.probability, 8);
  EXPECT_EQ(light.intensity, vec3(9, 10, 11));
  EXPECT_EQ(light.double_sided, 12u);
  EXPECT_EQ(light.edge1, vec3(13, 14, 15));
  EXPECT_EQ(light.area, 16);
  EXPECT_EQ(light.edge2, vec3(17, 18, 19));
  EXPECT_EQ(light.triangle, 20u);
  EXPECT_EQ(light.cone_scale, 21);
  EXPECT_EQ(light.cone_versine, 22);
  EXPECT_EQ(light.media, glm::uvec4(25, 26, 27, 28));
  const auto end = ends.download<shared::PhotonEnd>()[1];
  EXPECT_EQ(end.flux, vec3(1, 2, 3));
  EXPECT_EQ(end.end, 4u);
  EXPECT_EQ(end.entered, 5);
  EXPECT_EQ(end.absorbed, 6);
  EXPECT_EQ(end.cut, 7);
  EXPECT_EQ(end.map, 8u);
  const auto disc = discs.download<shared::PhotonDisc>()[1];
  EXPECT_EQ(disc.position, vec3(1, 2, 3));
  EXPECT_EQ(disc.flux_r, 4);
  EXPECT_EQ(disc.alpha, vec3(5, 6, 7));
  EXPECT_EQ(disc.flux_g, 8);
  EXPECT_EQ(disc.beta, vec3(9, 10, 11));
  EXPECT_EQ(disc.flux_b, 12);
  const auto sample = samples.download<shared::PixelSample>()[1];
  EXPECT_EQ(sample.position, vec3(1, 2, 3));
  EXPECT_EQ(sample.depth, 4);
  EXPECT_EQ(sample.normal, vec3(5, 6, 7));
  EXPECT_EQ(sample.meniscus, 8);
  EXPECT_EQ(sample.albedo, vec3(9, 10, 11));
  EXPECT_EQ(sample.triangle, 12u);
  EXPECT_EQ(sample.weight, vec3(13, 14, 15));
  EXPECT_EQ(sample.emitted, vec3(17, 18, 19));
  EXPECT_EQ(sample.direct, vec3(21, 22, 23));
  EXPECT_EQ(sample.targeted, vec3(25, 26, 27));
  EXPECT_EQ(sample.targeted_count, 28);
  EXPECT_EQ(sample.caustic, vec3(29, 30, 31));
  EXPECT_EQ(sample.caustic_count, 32);
  EXPECT_EQ(sample.global, vec3(33, 34, 35));
  EXPECT_EQ(sample.global_count, 36);
  const auto material = materials.download<shared::MaterialTextures>()[1];
  EXPECT_EQ(glm::uvec4(material.base, material.metallic_roughness, material.normal, material.emissive),
            glm::uvec4(1, 2, 3, 4));
  EXPECT_EQ(glm::vec4(material.metallic, material.roughness, material.least_roughness, material.normal_scale),
            glm::vec4(5, 6, 7, 8));
  const auto texture = textures.download<shared::Texture>()[1];
  EXPECT_EQ(texture.s, vec3(1, 2, 3));
  EXPECT_EQ(texture.first, 4u);
  EXPECT_EQ(texture.t, vec3(5, 6, 7));
  EXPECT_EQ(texture.reading, 8u);
  EXPECT_EQ(glm::uvec2(texture.width, texture.height), glm::uvec2(9, 10));
}

}  // namespace
}  // namespace meniscal

// The scenes that come with the program load, without a warning, and are what their names say.
#include <gtest/gtest.h>

#include <filesystem>

#include "host/scene/scene.h"

namespace meniscal {
namespace {

const Object& find(const Scene& scene, const std::string& name) {
  for (const Object& object : scene.objects)
    if (object.name == name) return object;
  throw std::out_of_range(name);
}

Scene load(const std::string& name) { return load_gltf(std::string(SCENES) + "/" + name + ".gltf"); }

TEST(SceneFilesOfTheProgram, LoadWithoutWarnings) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SCENES)) {
    if (entry.path().extension() != ".gltf") continue;
    const Scene scene = load_gltf(entry.path().string());
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
    ++count;
  }
  EXPECT_GE(count, 10);
}

TEST(SceneFilesOfTheProgram, SolidsAreClosedAndFaceOutwards) {
  for (const auto& [file, name] : {std::pair{"post", "post"},
                                   {"post_stub", "post"},
                                   {"two_posts", "post left"},
                                   {"sphere", "sphere"},
                                   {"box", "box"},
                                   {"shadow_sausage", "rod"},
                                   {"shadow_sausage", "dish"}}) {
    const Scene scene = load(file);
    const Object& object = find(scene, name);
    EXPECT_TRUE(object.closed) << file << ": " << name;
    double volume = 0;  // signed: positive where the triangles face outwards
    const auto& p = object.mesh.positions;
    for (const glm::uvec3& t : object.mesh.triangles) {
      volume += glm::dot(p[t.x], glm::cross(p[t.y], p[t.z])) / 6;
      const glm::dvec3 facet = glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]);
      for (int k = 0; k < 3; ++k)
        EXPECT_GT(glm::dot(facet, object.mesh.normals[t[k]]), 0.9 * glm::length(facet)) << file;
    }
    EXPECT_GT(volume, 0) << file << ": " << name;
  }
}

TEST(SceneFilesOfTheProgram, PostHasTheReferenceTablesDimensions) {
  const Scene scene = load("post");
  const double water = find(scene, "water").mesh.positions[0].y, floor = find(scene, "floor").mesh.positions[0].y;
  EXPECT_NEAR(water + scene.origin.y, 0, 1e-12);
  EXPECT_NEAR(water - floor, 0.05, 1e-8);
  EXPECT_NEAR(find(scene, "water").mesh.normals[0].y, 1, 1e-12);
  for (const glm::dvec3& p : find(scene, "post").mesh.positions) {
    const bool on_axis = std::hypot(p.x, p.z) < 1e-6;  // a cap's middle
    EXPECT_NEAR(std::hypot(p.x, p.z), on_axis ? 0 : 0.002, 1e-9);
  }
  EXPECT_EQ(scene.materials[static_cast<std::size_t>(find(scene, "post").material)].contact_angle, 30);
  EXPECT_NEAR(scene.cameras[0].xmag, 0.0122, 1e-15);
  EXPECT_NEAR(scene.lights[0].direction.y, -1, 1e-12);
}

}  // namespace
}  // namespace meniscal

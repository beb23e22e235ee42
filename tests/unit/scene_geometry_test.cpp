// Vertices as the renderer gets them: transforms, origin, normals, triangulation, closedness (host/scene/geometry.h,
// gltf.cpp).
#include <array>
#include <numbers>

#include "tests/unit/scene_fixture.h"

namespace meniscal::testing {
namespace {

using glm::dvec3;

class SceneGeometry : public SceneFiles {
 protected:
  // World position of a vertex, from its local one.
  static dvec3 world(const Scene& scene, std::size_t object, std::size_t vertex) {
    return scene.objects.at(object).mesh.positions.at(vertex) + scene.origin;
  }
};

// The eight corners and twelve outward triangles of the cube [-1, 1]^3.
const std::vector<float> cube_positions = {-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1,
                                           -1, -1, 1,  1, -1, 1,  1, 1, 1,  -1, 1, 1};
const std::vector<std::uint32_t> cube_indices = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                                 2, 3, 7, 2, 7, 6, 0, 4, 7, 0, 7, 3, 1, 2, 6, 1, 6, 5};

Document cube(const std::vector<std::uint32_t>& indices = cube_indices) {
  Document document = triangle();
  const int positions = document.vec3(cube_positions);
  document.json["meshes"][0]["primitives"] = {
      {{"attributes", {{"POSITION", positions}}}, {"indices", document.indices(indices)}, {"material", 0}}};
  return document;
}

TEST_F(SceneGeometry, ComposesTransformsFromTheRootDown) {
  Document document = triangle();
  const double h = std::sqrt(0.5);
  document.json["nodes"] = {{{"translation", {10, 0, 0}}, {"rotation", {0, h, 0, h}}, {"children", {1}}},
                            {{"mesh", 0}, {"translation", {0, 2, 0}}, {"scale", {2, 3, 4}}}};
  const Scene scene = load(document);
  // (1, 0, 0) scaled to (2, 0, 0), moved to (2, 2, 0), turned by 90 degrees about Y to (0, 2, -2), moved by 10.
  EXPECT_NEAR3(world(scene, 0, 1), dvec3(10, 2, -2), 1e-12);
  EXPECT_NEAR3(facet_normal(scene.objects[0].mesh, 0), dvec3(1, 0, 0), 1e-12);
}

TEST_F(SceneGeometry, MatrixIsColumnMajor) {
  Document document = triangle();
  document.json["nodes"][0]["matrix"] = {0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 5, 6, 7, 1};  // 90 degrees about Y
  EXPECT_NEAR3(world(load(document), 0, 1), dvec3(5, 6, 6), 1e-12);
}

TEST_F(SceneGeometry, MirroringKeepsTheOutsideOutside) {
  Document document = cube();
  document.json["nodes"][0]["scale"] = {-1, 2, 1};
  const Scene scene = load(document);
  const meniscus::TriangleMesh& mesh = scene.objects[0].mesh;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const dvec3 centre = world(scene, 0, mesh.triangles[t].x) + world(scene, 0, mesh.triangles[t].y) +
                         world(scene, 0, mesh.triangles[t].z);
    EXPECT_GT(glm::dot(facet_normal(mesh, t), centre), 0);
    EXPECT_GT(glm::dot(mesh.normals[mesh.triangles[t].x], facet_normal(mesh, t)), 0.99);
  }
}

TEST_F(SceneGeometry, NormalsTransformByTheInverseTranspose) {
  Document document = triangle();
  const float s = static_cast<float>(std::sqrt(0.5));
  document.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = document.vec3({s, s, 0, s, s, 0, s, s, 0});
  document.json["nodes"][0]["scale"] = {2, 1, 1};
  EXPECT_NEAR3(load(document).objects[0].mesh.normals[0], glm::normalize(dvec3(0.5, 1, 0)), 1e-7);
  document.json["nodes"][0]["scale"] = {-2, 1, 1};
  EXPECT_NEAR3(load(document).objects[0].mesh.normals[0], glm::normalize(dvec3(-0.5, 1, 0)), 1e-7);
}

TEST_F(SceneGeometry, OriginIsNearTheCentreAndExactlyZeroForACentredScene) {
  EXPECT_EQ(load(cube()).origin, dvec3(0));
  Document document = cube();
  document.json["nodes"][0]["translation"] = {0.3, 0, 0};
  const Scene scene = load(document);
  EXPECT_NE(scene.origin.x, 0);
  EXPECT_NEAR3(scene.origin, dvec3(0.3, 0, 0), 0.002);
  EXPECT_NEAR3(world(scene, 0, 0), dvec3(-0.7, -1, -1), 1e-12);
}

TEST_F(SceneGeometry, TenKilometresAwayIsTheSameScene) {
  Document document = cube();
  document.json["nodes"] = {{{"children", {1, 2}}},
                            {{"mesh", 0}, {"scale", {0.001, 0.001, 0.001}}, {"translation", {0.0001, 0.0003, 0}}},
                            {{"camera", 0}, {"translation", {0, 0.1, 0}}}};
  document.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.01}}}}};
  const Scene here = load(document);
  document.json["nodes"][0]["translation"] = {10000, -10000, 10000};
  const Scene there = load(document);
  const auto& a = here.objects[0].mesh.positions;
  const auto& b = there.objects[0].mesh.positions;
  ASSERT_EQ(a.size(), b.size());
  // One unit in the last place of 10 km in double: 1.8e-12 m.
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR3(a[i] - b[i], dvec3(0), 4e-12);
  EXPECT_NEAR3(dvec3(here.cameras[0].pose[3]), dvec3(there.cameras[0].pose[3]), 4e-12);
}

TEST_F(SceneGeometry, FacetNormalsWhereTheFileHasNone) {
  const Scene scene = load(cube());
  const Object& object = scene.objects[0];
  EXPECT_FALSE(object.has_file_normals);
  ASSERT_EQ(object.mesh.positions.size(), 36u);
  ASSERT_EQ(object.mesh.normals.size(), 36u);
  for (std::size_t t = 0; t < 12; ++t)
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR3(object.mesh.normals[object.mesh.triangles[t][k]], facet_normal(object.mesh, t), 1e-12);
}

TEST_F(SceneGeometry, ZeroAndNanNormalsBecomeFacetNormals) {
  Document document = triangle();
  document.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
      document.vec3({0, 1, 0, 0, 0, 0, std::numeric_limits<float>::quiet_NaN(), 0, 0});
  const Object object = load(document).objects[0];
  EXPECT_TRUE(object.has_file_normals);
  const glm::uvec3 t = object.mesh.triangles[0];
  EXPECT_NEAR3(object.mesh.normals[t.x], dvec3(0, 1, 0), 1e-12);
  EXPECT_NEAR3(object.mesh.normals[t.y], dvec3(0, 0, 1), 1e-12);
  EXPECT_NEAR3(object.mesh.normals[t.z], dvec3(0, 0, 1), 1e-12);
}

TEST_F(SceneGeometry, ClosednessLooksAtTheWholeMesh) {
  EXPECT_TRUE(load(cube()).objects[0].closed);
  std::vector<std::uint32_t> open(cube_indices.begin() + 3, cube_indices.end());
  EXPECT_FALSE(load(cube(open)).objects[0].closed);

  Document two = cube();  // two primitives, half of the cube each
  auto& primitives = two.json["meshes"][0]["primitives"];
  const int positions = primitives[0]["attributes"]["POSITION"];
  primitives = Json::array();
  for (const std::vector<std::uint32_t>& half : {std::vector(cube_indices.begin(), cube_indices.begin() + 18),
                                                 std::vector(cube_indices.begin() + 18, cube_indices.end())})
    primitives.push_back({{"attributes", {{"POSITION", positions}}}, {"indices", two.indices(half)}});
  const Scene scene = load(two);
  ASSERT_EQ(scene.objects.size(), 2u);
  EXPECT_EQ(scene.objects[0].name, "thing/0");
  EXPECT_EQ(scene.objects[1].name, "thing/1");
  EXPECT_TRUE(scene.objects[0].closed && scene.objects[1].closed);
}

TEST_F(SceneGeometry, ClosednessMergesEqualPositions) {
  Document document = triangle();  // every corner its own vertex
  std::vector<float> corners;
  for (const std::uint32_t i : cube_indices)
    for (std::uint32_t k = 0; k < 3; ++k) corners.push_back(cube_positions[3 * i + k]);
  document.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = document.vec3(corners);
  EXPECT_TRUE(load(document).objects[0].closed);
}

TEST_F(SceneGeometry, StripsAndFansKeepTheirSide) {
  for (const int mode : {5, 6}) {
    Document document = triangle();
    // A square facing +Z, its corners in the order of a strip or a fan.
    const std::vector<float> corners = mode == 5 ? std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}
                                                 : std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    document.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = document.vec3(corners);
    document.json["meshes"][0]["primitives"][0]["mode"] = mode;
    const meniscus::TriangleMesh mesh = load(document).objects[0].mesh;
    ASSERT_EQ(mesh.triangles.size(), 2u);
    for (std::size_t t = 0; t < 2; ++t) EXPECT_NEAR3(facet_normal(mesh, t), dvec3(0, 0, 1), 1e-12);
  }
}

TEST_F(SceneGeometry, LeavesOutLinesAndDegenerateTrianglesWithAWarning) {
  Document document = cube();
  auto& primitives = document.json["meshes"][0]["primitives"];
  std::vector<std::uint32_t> indices = cube_indices;
  indices.insert(indices.end(), {0, 0, 1, 3, 3, 3});
  primitives[0]["indices"] = document.indices(indices);
  primitives.push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 1}});
  const Scene scene = load(document);
  ASSERT_EQ(scene.objects.size(), 1u);
  EXPECT_EQ(scene.objects[0].name, "thing");
  EXPECT_EQ(scene.objects[0].mesh.triangles.size(), 12u);
  EXPECT_TRUE(scene.objects[0].closed);
  EXPECT_EQ(count_warnings(scene, {"mesh \"shape\"", "2 triangles without area"}), 1u);
  EXPECT_EQ(count_warnings(scene, {"mesh \"shape\"", "lines"}), 1u);
}

TEST_F(SceneGeometry, ReadsEveryIndexType) {
  for (const int type : {5121, 5123, 5125}) {
    Document document = triangle();
    const std::string bytes = type == 5121   ? std::string("\2\1\0", 3)
                              : type == 5123 ? bytes_of(std::vector<std::uint16_t>{2, 1, 0})
                                             : bytes_of(std::vector<std::uint32_t>{2, 1, 0});
    document.json["meshes"][0]["primitives"][0]["indices"] = document.accessor(bytes, type, 3, "SCALAR");
    EXPECT_NEAR3(facet_normal(load(document).objects[0].mesh, 0), dvec3(0, 0, -1), 1e-12) << type;
  }
}

TEST_F(SceneGeometry, ReadsStridedPositions) {
  Document document = triangle();
  std::vector<float> interleaved;
  for (std::size_t i = 0; i < 3; ++i) {
    interleaved.insert(interleaved.end(), triangle_positions.begin() + 3 * i, triangle_positions.begin() + 3 * i + 3);
    interleaved.push_back(99);
  }
  const int index = document.accessor(bytes_of(interleaved), 5126, 3, "VEC3");
  document.json["bufferViews"].back()["byteStride"] = 16;
  document.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = index;
  EXPECT_NEAR3(world(load(document), 0, 2), dvec3(0, 1, 0), 1e-12);
}

TEST_F(SceneGeometry, ReadsSparsePositionsWithAndWithoutABase) {
  for (const bool base : {true, false}) {
    Document document = triangle();
    document.accessor(bytes_of(std::vector<std::uint16_t>{1, 2}), 5123, 2, "SCALAR");
    document.accessor(bytes_of(std::vector<float>{5, 0, 0, 0, 7, 0}), 5126, 2, "VEC3");
    Json& accessor = document.json["accessors"][0];
    if (!base) accessor.erase("bufferView");
    accessor["sparse"] = {
        {"count", 2}, {"indices", {{"bufferView", 1}, {"componentType", 5123}}}, {"values", {{"bufferView", 2}}}};
    const Scene scene = load(document);
    EXPECT_NEAR3(world(scene, 0, 0), dvec3(0), 1e-12);
    EXPECT_NEAR3(world(scene, 0, 1), dvec3(5, 0, 0), 1e-12);
    EXPECT_NEAR3(world(scene, 0, 2), dvec3(0, 7, 0), 1e-12);
  }
}

TEST_F(SceneGeometry, ReadsQuantisedMeshes) {
  Document document = triangle();
  const std::vector<std::int16_t> shorts = {0, 0, 0, 0, 32767, 0, 0, 0, 0, -32768, 0, 0};  // padded to 8 bytes
  const int positions = document.accessor(bytes_of(shorts), 5122, 3, "VEC3", {{"normalized", true}});
  document.json["bufferViews"].back()["byteStride"] = 8;
  const int normals =
      document.accessor(std::string("\0\x7f\0\0\0\x7f\0\0\0\x7f\0\0", 12), 5120, 3, "VEC3", {{"normalized", true}});
  document.json["bufferViews"].back()["byteStride"] = 4;
  document.json["meshes"][0]["primitives"][0]["attributes"] = {{"POSITION", positions}, {"NORMAL", normals}};
  document.json["extensionsRequired"] = document.json["extensionsUsed"] = {"KHR_mesh_quantization"};
  document.json["nodes"][0]["scale"] = {2, 2, 2};
  const Scene scene = load(document);
  EXPECT_NEAR3(world(scene, 0, 1), dvec3(2, 0, 0), 1e-12);
  EXPECT_NEAR3(world(scene, 0, 2), dvec3(0, -2, 0), 1e-12);  // -32768 is -1 as well
  EXPECT_NEAR3(scene.objects[0].mesh.normals[0], dvec3(0, 1, 0), 1e-12);

  document.json["accessors"][positions].erase("normalized");
  EXPECT_NEAR3(world(load(document), 0, 1), dvec3(65534, 0, 0), 1e-9);
}

// A smooth-shaded disc of liquid: Blender bends the rim's normals by 45 degrees.
TEST_F(SceneGeometry, FreeSurfaceNormalsThatStrayAreRecomputed) {
  Document document = triangle();
  std::vector<float> positions = {0, 0, 0}, normals = {0, 1, 0};
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i < 8; ++i) {
    const double a = 2 * std::numbers::pi * i / 8, s = std::sqrt(0.5);
    for (const double c : {std::cos(a), 0.0, std::sin(a)}) positions.push_back(static_cast<float>(c));
    for (const double c : {s * std::cos(a), s, s * std::sin(a)}) normals.push_back(static_cast<float>(c));
    for (const std::uint32_t c : {0u, 1 + (i + 1) % 8, 1 + i}) indices.push_back(c);
  }
  document.json["meshes"][0]["primitives"] = {
      {{"attributes", {{"POSITION", document.vec3(positions)}, {"NORMAL", document.vec3(normals)}}},
       {"indices", document.indices(indices)},
       {"material", 0}}};
  EXPECT_NEAR(load(document).objects[0].mesh.normals[1].y, std::sqrt(0.5), 1e-6);  // a solid stays as it is

  document.json["materials"][0]["extras"]["meniscus_liquid"] = "water";
  const Scene scene = load(document);
  EXPECT_EQ(count_warnings(scene, {"object \"thing\"", "45.0 degrees", "recomputed"}), 1u);
  for (const dvec3& n : scene.objects[0].mesh.normals) EXPECT_NEAR3(n, dvec3(0, 1, 0), 1e-12);
  EXPECT_EQ(scene.objects[0].mesh.triangles.size(), 8u);
}

}  // namespace
}  // namespace meniscal::testing

// Indices, buffer views, accessors and node graphs that must not pass (host/scene/validate.h, accessor.h).
#include <limits>

#include "tests/unit/scene_fixture.h"

namespace meniscal::testing {
namespace {

class SceneValidate : public SceneFiles {
 protected:
  // A triangle with one property set.
  static Document with(const std::string& pointer, const Json& value) {
    Document document = triangle();
    document.json[Json::json_pointer(pointer)] = value;
    return document;
  }
};

TEST_F(SceneValidate, UnknownRequiredExtensionIsNamed) {
  Document document = triangle();
  document.json["extensionsRequired"] = {"KHR_lights_punctual", "KHR_draco_mesh_compression"};
  expect_error(document, {"KHR_draco_mesh_compression", "not supported"});
}

TEST_F(SceneValidate, UnknownUsedExtensionIsMentionedOnce) {
  Document document = triangle();
  document.json["extensionsUsed"] = {"KHR_materials_ior", "EXT_a", "EXT_b"};
  const Scene scene = load(document);
  EXPECT_EQ(count_warnings(scene, {"EXT_a", "EXT_b"}), 1u);
  EXPECT_EQ(count_warnings(scene, {"KHR_materials_ior"}), 0u);
}

TEST_F(SceneValidate, IndicesOutOfRangeAreNamed) {
  expect_error(with("/nodes/0/mesh", 1), {"node \"thing\"", "mesh 1"});
  expect_error(with("/nodes/0/camera", 0), {"node \"thing\"", "camera 0"});
  expect_error(with("/nodes/0/children", {5}), {"node \"thing\"", "child node 5"});
  expect_error(with("/nodes/0/extensions/KHR_lights_punctual/light", 3), {"node \"thing\"", "light 3"});
  expect_error(with("/scene", 2), {"scene 2"});
  expect_error(with("/scenes/0/nodes/0", 9), {"node 9"});
  expect_error(with("/meshes/0/primitives/0/material", 4), {"mesh \"shape\"", "material 4"});
  expect_error(with("/meshes/0/primitives/0/attributes/POSITION", 4), {"mesh \"shape\"", "accessor 4"});
  expect_error(with("/meshes/0/primitives/0/mode", 7), {"mesh \"shape\"", "mode 7"});
  expect_error(with("/accessors/0/bufferView", 1), {"accessor 0", "bufferView 1"});
  expect_error(with("/bufferViews/0/buffer", 1), {"bufferView 0", "buffer 1"});
}

TEST_F(SceneValidate, AccessorsStayInTheirBuffers) {
  expect_error(with("/accessors/0/count", 4), {"accessor 0", "needs 48 bytes"});
  expect_error(with("/accessors/0/count", 2147483647), {"accessor 0"});
  expect_error(with("/accessors/0/count", 0), {"accessor 0", "empty"});
  expect_error(with("/accessors/0/byteOffset", 4), {"accessor 0", "needs 40 bytes"});
  expect_error(with("/bufferViews/0/byteOffset", 2147483647), {"bufferView 0"});
  expect_error(with("/bufferViews/0/byteLength", 37), {"bufferView 0"});
  expect_error(with("/bufferViews/0/byteStride", 8), {"accessor 0", "12 bytes, 8 apart"});
  expect_error(with("/bufferViews/0/byteStride", 16), {"accessor 0", "needs 44 bytes"});
  expect_error(with("/accessors/0/componentType", 5124), {"accessor 0", "5124"});
  expect_error(with("/accessors/0/type", "VEC4"), {"accessor 0"});
  Document zeros = triangle();
  zeros.json["accessors"][0] = {{"componentType", 5126}, {"type", "VEC3"}, {"count", 2000000000}};
  expect_error(zeros, {"accessor 0", "no buffer view"});
}

TEST_F(SceneValidate, ComponentTypesFitTheirUse) {
  Document document = triangle();  // integers as positions without KHR_mesh_quantization
  const int shorts = document.accessor(std::string(24, '\1'), 5122, 3, "VEC3");
  document.json["bufferViews"].back()["byteStride"] = 8;
  document.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = shorts;
  expect_error(document, {"component type 5122", "KHR_mesh_quantization"});
  Document indices = triangle();
  indices.json["meshes"][0]["primitives"][0]["indices"] = indices.accessor(std::string(12, '\0'), 5126, 3, "SCALAR");
  expect_error(indices, {"accessor 1", "indices"});
}

TEST_F(SceneValidate, VertexIndicesAreBelowTheVertexCount) {
  Document document = triangle();
  document.json["meshes"][0]["primitives"][0]["indices"] = document.indices({0, 1, 3});
  expect_error(document, {"accessor 1", "vertex index 3", "3 vertices"});
  Document remainder = triangle();
  remainder.json["meshes"][0]["primitives"][0]["indices"] = remainder.indices({0, 1, 2, 0});
  expect_error(remainder, {"mesh \"shape\"", "4 indices"});
}

TEST_F(SceneValidate, AttributesHaveOneCount) {
  Document document = triangle();
  document.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = document.vec3({0, 0, 1});
  expect_error(document, {"mesh \"shape\"", "attributes of"});
}

TEST_F(SceneValidate, PositionsAreFinite) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    Document document = triangle();
    std::memcpy(document.buffer.data() + 16, &bad, 4);
    expect_error(document, {"accessor 0", "not finite", "element 1"});
  }
}

TEST_F(SceneValidate, SparseAccessorsStayInBounds) {
  const auto sparse = [](Json patch, const std::vector<std::uint16_t>& where) {
    Document document = triangle();
    document.accessor(bytes_of(where), 5123, where.size(), "SCALAR");
    document.accessor(bytes_of(std::vector<float>{3, 0, 0, 0, 4, 0}), 5126, 2, "VEC3");
    document.json["accessors"][0]["sparse"] = {
        {"count", 2}, {"indices", {{"bufferView", 1}, {"componentType", 5123}}}, {"values", {{"bufferView", 2}}}};
    document.json["accessors"][0]["sparse"].merge_patch(patch);
    return document;
  };
  EXPECT_NO_THROW(load(sparse(Json::object(), {0, 2})));
  expect_error(sparse(Json::object(), {0, 3}), {"accessor 0", "sparse index 3"});
  expect_error(sparse(Json::object(), {2, 0}), {"accessor 0", "sparse index 0 after 2"});
  expect_error(sparse({{"count", 3}}, {0, 2}), {"accessor 0", "bufferView 1"});
  expect_error(sparse({{"count", 4}}, {0, 2}), {"accessor 0", "replaces 4 of 3"});
  expect_error(sparse({{"indices", {{"byteOffset", 2}}}}, {0, 2}), {"accessor 0"});
  expect_error(sparse({{"values", {{"bufferView", 9}}}}, {0, 2}), {"bufferView 9"});
  expect_error(sparse({{"indices", {{"componentType", 5126}}}}, {0, 2}), {"5126"});
  expect_error(sparse({{"indices", {{"byteOffset", 4294967296}}}}, {0, 2}), {"byteOffset"});  // 0 in 32 bits
}

TEST_F(SceneValidate, NodesFormAForest) {
  Document cycle = triangle();
  cycle.json["nodes"] = {{{"mesh", 0}, {"name", "root"}}, {{"children", {2}}}, {{"children", {1}}}};
  expect_error(cycle, {"own ancestor"});
  Document self = triangle();
  self.json["nodes"] = {{{"mesh", 0}, {"name", "root"}, {"children", {0}}}};
  expect_error(self, {"node \"root\"", "own ancestor"});
  Document parents = triangle();
  parents.json["nodes"] = {{{"mesh", 0}, {"children", {2}}}, {{"children", {2}}}, {{"name", "child"}}};
  expect_error(parents, {"node \"child\"", "node 0", "node 1"});
  Document listed = triangle();
  listed.json["nodes"] = {{{"mesh", 0}, {"children", {1}}}, {{"name", "child"}}};
  listed.json["scenes"][0]["nodes"] = {0, 1};
  expect_error(listed, {"scene 0", "node 1"});
  expect_error(with("/scenes/0/nodes", {0, 0}), {"node 0 twice"});
}

TEST_F(SceneValidate, DeepHierarchiesAreWalkedWithoutRecursion) {
  Document document = triangle();
  Json nodes = Json::array();
  constexpr int depth = 100000;
  for (int i = 0; i < depth; ++i) nodes.push_back({{"children", {i + 1}}});
  nodes.push_back({{"mesh", 0}, {"name", "leaf"}});
  document.json["nodes"] = nodes;
  EXPECT_EQ(load(document).objects.at(0).name, "leaf");
}

TEST_F(SceneValidate, AFewNumbersCannotAskForUnboundedGeometry) {
  Document document = triangle();  // 1000 instances of 15 million zeros
  document.json["accessors"][0] = {{"componentType", 5126}, {"type", "VEC3"}, {"count", 15000000}};
  for (int i = 1; i < 1000; ++i) {
    document.json["nodes"].push_back({{"mesh", 0}});
    document.json["scenes"][0]["nodes"].push_back(i);
  }
  expect_error(document, {"node 4", "above 67108864 vertices"});
}

TEST_F(SceneValidate, TransformsAreUsable) {
  expect_error(with("/nodes/0/rotation", {0, 0, 0, 0}), {"node \"thing\"", "quaternion"});
  expect_error(with("/nodes/0/matrix", {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}),
               {"node \"thing\"", "last row"});
  expect_error(with("/nodes/0/scale", {1, 1}), {"node \"thing\"", "scale"});
  expect_error(with("/nodes/0/scale", {1e308, 1e308, 1}), {"scene", "inf m across"});
  expect_error(with("/nodes/0/scale", {0, 0, 0}), {"no triangle with an area"});
}

TEST_F(SceneValidate, ASceneWithoutObjectsIsAnError) {
  Document document = triangle();
  document.json["nodes"][0].erase("mesh");
  expect_error(document, {"no triangles"});
  expect_error(with("/meshes/0/primitives/0/mode", 1), {"no triangles"});
}

}  // namespace
}  // namespace meniscal::testing

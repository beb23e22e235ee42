// Scene files that are damaged or mean harm: the program's answer, within bounds. What exactly is refused, and why, is
// tested where it is read (scene_guard_test.cpp, scene_validate_test.cpp).
#include <cmath>
#include <limits>

#include "tests/unit/hostile.h"
#include "tests/unit/scene_fixture.h"

namespace meniscal::test {
namespace {

using testing::bytes_of;
using testing::Document;
using testing::Json;

std::string corpus(const std::string& name) { return read_bytes(FUZZ_CORPUS "/scene/" + name); }

Document with(const std::string& pointer, const Json& value) {
  Document document = testing::triangle();
  document.json[Json::json_pointer(pointer)] = value;
  return document;
}

class HostileScene : public ::testing::Test {
 protected:
  void refused(const Document& document, const std::vector<std::string>& parts) {
    refused_text(document.text(), parts);
  }
  void refused_text(const std::string& text, const std::vector<std::string>& parts) {
    expect_refused(folder, "scene.gltf", text, parts);
  }
  const TemporaryFolder folder;
};

TEST_F(HostileScene, CutOffAnywhere) {
  for (const std::string name : {"triangle.gltf", "lit_water.glb", "sparse.glb", "textured_png.glb"})
    for (std::size_t i = 0; i < 16; ++i) expect_refused(folder, std::to_string(i) + name, cut(corpus(name), i), {});
}

TEST_F(HostileScene, CountsBeyondTheFile) {
  for (const double count : {std::exp2(31) - 1, std::exp2(31), std::exp2(32), std::exp2(53), std::exp2(63), 1e300}) {
    const Json number = count < std::exp2(63) ? Json(static_cast<std::uint64_t>(count)) : Json(count);
    refused(with("/accessors/0/count", number), {"accessor"});
    refused(with("/bufferViews/0/byteLength", number), {"bufferView"});
    refused(with("/bufferViews/0/byteOffset", number), {"bufferView"});
    refused(with("/accessors/0/byteOffset", number), {"accessor"});
    refused(with("/bufferViews/0/byteStride", number), {"byteStride"});
  }
  // In 32 bits their sum would be negative and their product 8.
  Document wraps = with("/bufferViews/0/byteOffset", 2147483647);
  wraps.json["bufferViews"][0]["byteLength"] = 2147483647;
  refused(wraps, {"bufferView 0"});
  Document product = with("/bufferViews/0/byteStride", 252);
  product.json["accessors"][0]["count"] = 17043522;
  refused(product, {"accessor 0", "4294967304 bytes"});
}

TEST_F(HostileScene, ZerosThatNoByteOfTheFileStandsFor) {
  const auto zeros = [](std::uint64_t count) {
    return with("/accessors/0", {{"componentType", 5126}, {"type", "VEC3"}, {"count", count}});
  };
  refused(zeros(2147483647), {"accessor 0", "no buffer view"});
  refused(zeros(16777215), {"accessor 0", "no buffer view"});  // 400 MB of coordinates
  Document sparse = zeros(16777215);
  const int where = sparse.accessor(bytes_of(std::vector<std::uint32_t>{7}), 5125, 1, "SCALAR");
  const int what = sparse.vec3({1, 2, 3});
  const auto view = [&](int accessor) { return sparse.json["accessors"][accessor]["bufferView"]; };
  sparse.json["accessors"][0]["sparse"] = {{"count", 1},
                                           {"indices", {{"bufferView", view(where)}, {"componentType", 5125}}},
                                           {"values", {{"bufferView", view(what)}}}};
  refused(sparse, {"accessor 0", "no buffer view"});
}

TEST_F(HostileScene, BuffersShorterThanTheyClaim) {
  for (const std::uint64_t length : {37ull, 2147483647ull, 4294967332ull, 1ull << 53}) {
    Document document = testing::triangle();
    Json json = document.json;
    json["buffers"] =
        Json::array({{{"byteLength", length},
                      {"uri", "data:application/octet-stream;base64," + testing::base64(document.buffer)}}});
    refused_text(json.dump(), {});
    json["buffers"][0].erase("uri");
    refused_text(json.dump(), {});
  }
}

TEST_F(HostileScene, ChunksBeyondTheFile) {
  const std::string good = corpus("triangle.glb");
  const auto word = [](std::uint32_t value) { return bytes_of(std::vector<std::uint32_t>{value}); };
  std::uint32_t json_length;
  std::memcpy(&json_length, good.data() + 12, 4);
  for (const std::size_t at : {std::size_t{8}, std::size_t{12}, std::size_t{20} + json_length})
    for (const std::uint32_t length : {0x7fffffffu, 0x80000000u, 0xfffffff0u, 0xffffffffu}) {
      std::string bad = good;
      bad.replace(at, 4, word(length));
      expect_refused(folder, "scene.glb", bad, {"GLB"});
    }
}

TEST_F(HostileScene, NestsAndCycles) {
  refused_text(std::string(1000000, '['), {"nests deeper"});
  std::string objects;
  for (int i = 0; i < 100000; ++i) objects += "{\"a\":";
  refused_text(objects, {"nests deeper"});
  Document cycle = testing::triangle();
  constexpr int length = 100000;
  for (int i = 1; i <= length; ++i) cycle.json["nodes"].push_back({{"children", {i % length + 1}}});
  refused(cycle, {"own ancestor"});
}

TEST_F(HostileScene, PathsOutOfTheFolder) {
  for (const std::string uri : {"../../../../../../etc/passwd", "/etc/passwd", "%2e%2e/%2e%2e/etc/passwd",
                                "file:///etc/passwd", "//etc/passwd", "a/../../b.bin"}) {
    Json json = testing::triangle().json;
    json["buffers"] = {{{"byteLength", 36}, {"uri", uri}}};
    refused_text(json.dump(), {uri.substr(uri.rfind('/'))});
    Document image = testing::triangle();
    image.json["images"] = {{{"uri", uri}}};
    image.json["textures"] = {{{"source", 0}}};
    image.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
    refused(image, {uri.substr(uri.rfind('/'))});
    refused(with("/scenes/0/extras", {{"environment", uri}}), {uri.substr(uri.rfind('/'))});
  }
}

TEST_F(HostileScene, NumbersThatAreNone) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                          -std::numeric_limits<float>::infinity()}) {
    Document document = testing::triangle();
    std::memcpy(document.buffer.data() + 20, &bad, 4);
    refused(document, {"accessor 0", "not finite"});
  }
  refused_text("{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"translation\":[NaN,0,0]}]}", {"JSON"});
  refused_text("{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"translation\":[1e999,0,0]}]}", {"JSON"});
  refused(with("/nodes/0/translation", {1e308, 1e308, -1e308}), {});
  refused(with("/nodes/0/scale", {1e300, 1e300, 1e300}), {});
}

// What single precision cannot hold, or squares of it.
TEST_F(HostileScene, NumbersThatAreTooGreat) {
  refused(with("/nodes/0/scale", {1e13, 1e13, 1e13}), {"m across", "1e+12"});
  refused(with("/nodes/0/scale", {1e-14, 1e-14, 1e-14}), {"m across", "1e-12"});
  const auto lit = [](const Json& light) {
    Document document = testing::triangle();
    document.json["extensionsUsed"] = Json::array({"KHR_lights_punctual"});
    document.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({light});
    document.json["nodes"].push_back(
        {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}, {"translation", {0, 1e13, 0}}});
    document.json["scenes"][0]["nodes"].push_back(document.json["nodes"].size() - 1);
    return document;
  };
  refused(lit({{"type", "directional"}, {"intensity", 1e39}}), {"intensity", "1e+24"});
  refused(lit({{"type", "directional"}, {"color", {1e7, 0, 0}}}), {"color", "1000000"});
  refused(lit({{"type", "point"}}), {"light 0", "m from the scene", "1e+12"});
  refused(with("/materials/0/extensions/KHR_materials_emissive_strength/emissiveStrength", 1e39),
          {"emissiveStrength", "1e+24"});
}

TEST_F(HostileScene, IndicesOutOfRange) {
  for (const std::uint32_t index : {3u, 0x7fffffffu, 0xffffffffu}) {
    Document document = testing::triangle();
    document.json["meshes"][0]["primitives"][0]["indices"] = document.indices({0, 1, index});
    refused(document, {"vertex index " + std::to_string(index)});
  }
}

}  // namespace
}  // namespace meniscal::test

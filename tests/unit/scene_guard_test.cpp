// What a scene file may make the program read (host/scene/guard.h, schema.h).
#include <sys/stat.h>

#include "tests/unit/scene_fixture.h"

namespace meniscal::testing {
namespace {

namespace fs = std::filesystem;

class SceneGuard : public SceneFiles {
 protected:
  // A triangle whose buffer is the file `uri`.
  std::string with_buffer_uri(const std::string& uri) {
    Document document = triangle();
    document.json["buffers"] = Json::array({{{"byteLength", document.buffer.size()}, {"uri", uri}}});
    return document.json.dump();
  }
  std::string geometry() { return triangle().buffer; }
};

TEST_F(SceneGuard, ReadsABufferBesideTheSceneAndInASubfolder) {
  write(folder / "my data.bin", geometry());
  fs::create_directory(folder / "sub");
  write(folder / "sub" / "b.bin", geometry());
  EXPECT_EQ(load(with_buffer_uri("my%20data.bin")).objects.size(), 1u);
  EXPECT_EQ(load(with_buffer_uri("./sub/b.bin")).objects.size(), 1u);
}

TEST_F(SceneGuard, RefusesPathsOutOfTheFolder) {
  write(root / "secret.bin", geometry());
  for (const std::string& uri : {std::string("../secret.bin"), std::string("%2e%2e/secret.bin"),
                                 std::string("%2E%2e%2fsecret.bin"), std::string("sub/../../secret.bin"),
                                 (root / "secret.bin").string(), "%2f" + (root / "secret.bin").string().substr(1)})
    expect_error(with_buffer_uri(uri), {"leads out of the scene's folder", "secret.bin"});
}

TEST_F(SceneGuard, RefusesAbsoluteAndUpwardPathsEvenWhereTheyLeadBack) {
  write(folder / "a.bin", geometry());
  fs::create_directory(folder / "sub");
  expect_error(with_buffer_uri((folder / "a.bin").string()), {"leads out of the scene's folder"});
  expect_error(with_buffer_uri("sub/../a.bin"), {"leads out of the scene's folder"});
}

TEST_F(SceneGuard, RefusesNulBytesInPaths) {
  write(folder / "a.bin", geometry());
  expect_error(with_buffer_uri("a.bin%00.txt"), {"leads out of the scene's folder"});
}

TEST_F(SceneGuard, FollowsSymbolicLinksOnlyInsideTheFolder) {
  write(root / "secret.bin", geometry());
  write(folder / "inside.bin", geometry());
  fs::create_symlink(root / "secret.bin", folder / "out.bin");
  fs::create_symlink("inside.bin", folder / "in.bin");
  fs::create_directory_symlink(root, folder / "up");
  expect_error(with_buffer_uri("out.bin"), {"leads out of the scene's folder"});
  expect_error(with_buffer_uri("up/secret.bin"), {"leads out of the scene's folder"});
  EXPECT_EQ(load(with_buffer_uri("in.bin")).objects.size(), 1u);
}

TEST_F(SceneGuard, RefusesFoldersAndPipes) {
  fs::create_directory(folder / "data");
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  expect_error(with_buffer_uri("data"), {"is not a plain file"});
  expect_error(with_buffer_uri("pipe"), {"is not a plain file"});
  EXPECT_THROW(load_gltf(folder.string()), Error);
}

TEST_F(SceneGuard, NamesMissingFiles) {
  expect_error(with_buffer_uri("nowhere.bin"), {"nowhere.bin"});
  EXPECT_THROW(load_gltf((folder / "none.gltf").string()), Error);
  EXPECT_THROW(load_gltf((folder / "none" / "none.gltf").string()), Error);
}

TEST_F(SceneGuard, RefusesABufferOfAnotherSize) {
  write(folder / "a.bin", geometry() + "more");
  expect_error(with_buffer_uri("a.bin"), {"a.bin"});
}

TEST_F(SceneGuard, RefusesFilesLargerThanTheCap) {
  write(folder / "huge.bin", "");
  fs::resize_file(folder / "huge.bin", std::uintmax_t{1} << 31);  // sparse: takes no space
  expect_error(with_buffer_uri("huge.bin"), {"huge.bin", "2147483648 bytes"});
}

TEST_F(SceneGuard, RefusesDeepJsonBeforeParsing) {
  const std::string head = R"({"asset":{"version":"2.0"},"extras":)";
  expect_error(head + std::string(200000, '[') + std::string(200000, ']') + "}", {"nests deeper than"});
  expect_error(std::string(1000000, '['), {"nests deeper than"});
  const auto nested = [&](std::size_t levels) {  // the root object is one of them
    return triangle().text().insert(1,
                                    "\"extras\":" + std::string(levels - 1, '[') + std::string(levels - 1, ']') + ",");
  };
  EXPECT_EQ(load(nested(64)).objects.size(), 1u);
  expect_error(nested(65), {"nests deeper than 64"});
  Document document = triangle();  // brackets in texts do not nest
  document.json["extras"]["text"] = std::string(1000, '[') + "\\\"" + std::string(1000, '{');
  EXPECT_EQ(load(document).objects.size(), 1u);
}

TEST_F(SceneGuard, RefusesWhatIsNoGltf) {
  expect_error("", {"JSON"});
  expect_error("hello", {"JSON"});
  expect_error("[]", {"not an object"});
  expect_error(R"({"asset":{"version":"1.0"}})", {"glTF 1.0"});
  expect_error(R"({"asset":{"version":"2.0"},"nodes":{}})", {"nodes", "not an array"});
  expect_error(R"({"asset":{"version":"2.0"},"meshes":[3]})", {"meshes"});
}

TEST_F(SceneGuard, RefusesWrongTypesThatTinygltfReplacesByDefaults) {
  const auto with = [](const std::string& pointer, const Json& value) {
    Document document = triangle();
    document.json[Json::json_pointer(pointer)] = value;
    return document;
  };
  expect_error(with("/nodes/0/mesh", "shape"), {"nodes[0].mesh"});
  expect_error(with("/nodes/0/mesh", -1), {"nodes[0].mesh"});
  expect_error(with("/nodes/0/mesh", 4294967296), {"nodes[0].mesh", "4294967296"});  // 0 in 32 bits
  expect_error(with("/nodes/0/translation", {1, 2}), {"nodes[0].translation", "3 numbers"});
  expect_error(with("/nodes/0/translation", {1, 2, "3"}), {"nodes[0].translation"});
  expect_error(with("/accessors/0/byteOffset", -4), {"accessors[0].byteOffset"});
  expect_error(with("/accessors/0/count", 4000000000), {"accessors[0].count", "4000000000"});
  expect_error(with("/meshes/0/primitives/0/attributes/POSITION", 4294967296), {"POSITION"});
  expect_error(with("/materials/0/pbrMetallicRoughness/roughnessFactor", "0"), {"roughnessFactor"});
  expect_error(with("/materials/0/extras/meniscus_density", 4294967297), {"meniscus_density"});
}

std::string word(std::uint32_t value) { return bytes_of(std::vector<std::uint32_t>{value}); }

std::string glb(const Document& document, std::uint32_t bin_length_lie = 0) {
  Json json = document.json;
  json["buffers"] = Json::array({{{"byteLength", document.buffer.size()}}});
  std::string text = json.dump();
  while (text.size() % 4 != 0) text += ' ';
  std::string bin = document.buffer;
  while (bin.size() % 4 != 0) bin += '\0';
  const auto bin_length = static_cast<std::uint32_t>(bin.size()) + bin_length_lie;
  const std::string chunks =
      word(static_cast<std::uint32_t>(text.size())) + "JSON" + text + word(bin_length) + std::string("BIN\0", 4) + bin;
  return "glTF" + word(2) + word(static_cast<std::uint32_t>(chunks.size() + 12)) + chunks;
}

TEST_F(SceneGuard, ReadsGlb) {
  const Scene scene = load(glb(triangle()), "scene.glb");
  ASSERT_EQ(scene.objects.size(), 1u);
  EXPECT_EQ(scene.objects[0].mesh.triangles.size(), 1u);
}

TEST_F(SceneGuard, RefusesBrokenGlb) {
  const std::string good = glb(triangle());
  expect_error(good.substr(0, good.size() - 8), {"GLB"}, "scene.glb");
  expect_error(good.substr(0, 16), {"GLB"}, "scene.glb");
  // tinygltf reads up to 8 bytes past the end here.
  expect_error(glb(triangle(), 4), {"GLB", "second chunk"}, "scene.glb");
  std::string version = good;
  version[4] = 1;
  expect_error(version, {"GLB", "version 1"}, "scene.glb");
  Document deep = triangle();
  const std::string text = glb(deep);
  std::string nested = "glTF" + word(2) + word(20 + 400000) + word(400000) + "JSON" + std::string(400000, '[');
  expect_error(nested, {"nests deeper than"}, "scene.glb");
}

TEST_F(SceneGuard, HashCoversFileAndBuffers) {
  write(folder / "a.bin", geometry());
  const std::string before = load(with_buffer_uri("a.bin")).hash;
  EXPECT_EQ(before, load(with_buffer_uri("a.bin")).hash);
  std::string other = geometry();
  other[4 * 3 + 2] ^= 1;
  write(folder / "a.bin", other);
  EXPECT_NE(before, load(with_buffer_uri("a.bin")).hash);
  EXPECT_EQ(before.size(), 16u);
}

TEST_F(SceneGuard, KeepsControlCharactersOutOfMessages) {
  Document document = triangle();
  document.json["nodes"][0]["name"] = "\x1b[31mred";
  document.json["nodes"][0]["mesh"] = 7;
  try {
    load(document);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find('\x1b'), std::string::npos);
  }
}

TEST_F(SceneGuard, UnusedImagesDoNotHinder) {
  Document document = triangle();
  document.json["images"] = {{{"uri", "missing.png"}}, {{"uri", "data:image/png;base64,AAAA"}}};
  document.json["textures"] = {{{"source", 0}}, {{"source", 1}}};
  document.json["materials"][0]["occlusionTexture"] = {{"index", 0}};
  EXPECT_NO_THROW(load(document));
}

}  // namespace
}  // namespace meniscal::testing

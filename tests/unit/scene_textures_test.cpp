// Textures from the file: images, samplers, transforms, coordinates (host/scene/images.h, textures.h, meshes.h), and
// how they are looked up (host/world/textures.h).
#include <png.h>
#include <stb_image_write.h>

#include <numbers>

#include "host/world/textures.h"
#include "tests/unit/scene_fixture.h"

namespace meniscal::testing {
namespace {

using glm::dvec2, glm::dvec3, glm::dvec4;

void append(void* bytes, void* data, int size) {
  static_cast<std::string*>(bytes)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

std::string png(int width, int height, int channels, const std::vector<std::uint8_t>& values) {
  std::string bytes;
  stbi_write_png_to_func(append, &bytes, width, height, channels, values.data(), 0);
  return bytes;
}

// Of 16 bits a channel.
std::string deep_png(int width, int height, const std::vector<std::uint16_t>& rgb) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(width);
  header.height = static_cast<png_uint_32>(height);
  header.format = PNG_FORMAT_LINEAR_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::string bytes(size, '\0');
  png_image_write_to_memory(&header, bytes.data(), &size, 0, rgb.data(), 0, nullptr);
  return bytes.substr(0, size);
}

// Red and green, blue and white, in rows.
const std::string four_colors = png(2, 2, 3, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255});

// The triangle with texture coordinates and a base colour of texture 0, image 0.
Document textured(const Json& image, const std::vector<float>& coordinates = {0, 0, 1, 0, 0, 1}) {
  Document document = triangle();
  document.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
      document.accessor(bytes_of(coordinates), 5126, coordinates.size() / 2, "VEC2");
  document.json["images"] = Json::array({image});
  document.json["textures"] = {{{"source", 0}}};
  document.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  return document;
}
Json as_data_uri(const std::string& bytes, const std::string& type = "png") {
  return {{"uri", "data:image/" + type + ";base64," + base64(bytes)}};
}

class SceneTextures : public SceneFiles {
 protected:
  // Of base colour.
  Texture texture(const Document& document) { return load(document).materials.at(0).base_color_texture.value(); }
  dvec4 color(const Document& document, dvec2 at) { return look_up(texture(document), dvec4(at, 0, 0)); }
};

TEST_F(SceneTextures, ImagesComeFromFilesTextAndBuffers) {
  write(folder / "a b.png", four_colors);
  Document in_buffer = textured(Json::object());
  while (in_buffer.buffer.size() % 4 != 0) in_buffer.buffer += '\0';
  in_buffer.json["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", in_buffer.buffer.size()}, {"byteLength", four_colors.size()}});
  in_buffer.buffer += four_colors;
  in_buffer.json["images"][0] = {{"bufferView", in_buffer.json["bufferViews"].size() - 1}, {"mimeType", "image/png"}};
  for (const Document& document : {textured({{"uri", "a%20b.png"}}), textured(as_data_uri(four_colors)), in_buffer}) {
    EXPECT_NEAR3(color(document, {0.25, 0.25}), dvec3(1, 0, 0), 1e-12);
    EXPECT_NEAR3(color(document, {0.75, 0.25}), dvec3(0, 1, 0), 1e-12);
    EXPECT_NEAR3(color(document, {0.25, 0.75}), dvec3(0, 0, 1), 1e-12);
    EXPECT_TRUE(load(document).warnings.size() <= 2) << "a camera and a light are missing, no more";
  }
}

TEST_F(SceneTextures, AreAStageOfLoadingWhereThereAreSome) {
  Document unused = triangle();
  unused.json["images"] = Json::array({as_data_uri(four_colors)});
  EXPECT_TRUE(load(unused).stages.seconds().empty());
  const auto seconds = load(textured(as_data_uri(four_colors))).stages.seconds();
  EXPECT_EQ(seconds.size(), 1u);
  EXPECT_TRUE(seconds.contains("images"));
}

TEST_F(SceneTextures, KindsOfImages) {
  std::string jpeg;
  stbi_write_jpg_to_func(append, &jpeg, 8, 8, 3, std::vector<std::uint8_t>(3 * 64, 128).data(), 95);
  EXPECT_NEAR3(color(textured(as_data_uri(jpeg, "jpeg")), {0.5, 0.5}), dvec3(0.2158605), 0.004);
  const dvec4 grey = color(textured(as_data_uri(png(1, 1, 1, {188}))), {0.5, 0.5});
  EXPECT_NEAR3(grey, dvec3(0.5028865), 1e-6);
  EXPECT_EQ(grey.w, 1);
  EXPECT_NEAR(color(textured(as_data_uri(png(1, 1, 2, {188, 51}))), {0.5, 0.5}).w, 0.2, 1e-12);
  EXPECT_NEAR(color(textured(as_data_uri(png(1, 1, 4, {1, 2, 3, 102}))), {0.5, 0.5}).w, 0.4, 1e-12);

  Document deep = textured(as_data_uri(deep_png(1, 1, {1, 40000, 65535})));
  deep.json["materials"][0]["pbrMetallicRoughness"] = {{"metallicRoughnessTexture", {{"index", 0}}}};
  const Material material = load(deep).materials.at(0);
  EXPECT_NEAR3(look_up(*material.metallic_roughness_texture, dvec4(0.5)), dvec3(1, 40000, 65535) / 65535.0, 1e-12);
  EXPECT_NEAR(material.most_roughness, 40000 / 65535.0, 1e-12);
  EXPECT_EQ(material.most_metallic, 1);
}

// Filtered in linear light: half way between black and white is 0.5, not what 0.5 encodes.
TEST_F(SceneTextures, FiltersInLinearLight) {
  Document document = textured(as_data_uri(png(2, 1, 1, {0, 255})));
  EXPECT_NEAR(color(document, {0.5, 0.5}).x, 0.5, 1e-12);
  EXPECT_NEAR(color(document, {0.625, 0.5}).x, 0.75, 1e-12);
  document.json["samplers"] = {{{"magFilter", 9728}}};
  document.json["textures"][0]["sampler"] = 0;
  EXPECT_EQ(color(document, {0.499, 0.5}).x, 0);
  EXPECT_EQ(color(document, {0.501, 0.5}).x, 1);
}

TEST_F(SceneTextures, WrapsEachDirectionByItself) {
  const auto with = [&](int wrap_s, int wrap_t) {
    Document document = textured(as_data_uri(png(4, 1, 1, {0, 0, 0, 255})));
    document.json["samplers"] = {{{"magFilter", 9728}, {"wrapS", wrap_s}, {"wrapT", wrap_t}}};
    document.json["textures"][0]["sampler"] = 0;
    return texture(document);
  };
  const auto at = [](const Texture& t, double x) { return look_up(t, dvec4(x, 7.3, 0, 0)).x; };
  const Texture repeated = with(10497, 33071), clamped = with(33071, 10497), mirrored = with(33648, 33648);
  EXPECT_EQ(at(repeated, 1.9), 1);
  EXPECT_EQ(at(repeated, -0.1), 1);
  EXPECT_EQ(at(repeated, 1.1), 0);
  EXPECT_EQ(at(clamped, 5.1), 1);
  EXPECT_EQ(at(clamped, -0.1), 0);
  EXPECT_EQ(at(mirrored, 1.1), 1);
  EXPECT_EQ(at(mirrored, 1.3), 0);
  EXPECT_EQ(at(mirrored, -0.9), 1);
  EXPECT_EQ(at(mirrored, 1.9), 0);
  // Bilinear across the border: to the other end, to itself, to itself.
  for (const auto& [texture, expected] :
       {std::pair(repeated, 0.5), std::pair(clamped, 1.0), std::pair(mirrored, 1.0)}) {
    Texture smooth = texture;
    smooth.nearest = false;
    EXPECT_NEAR(at(smooth, 1.0), expected, 1e-9);
  }
}

TEST_F(SceneTextures, TransformIsOffsetRotationScale) {
  Document document = textured(as_data_uri(four_colors));
  document.json["extensionsUsed"] = {"KHR_texture_transform"};
  document.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"] = {
      {"offset", {0.125, 0.5}}, {"rotation", std::numbers::pi / 2}, {"scale", {2, 3}}, {"texCoord", 1}};
  document.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = 1;
  const Texture t = texture(document);
  EXPECT_EQ(t.set, 1);
  // Scaled to (0.5, 0.3), turned to (0.3, -0.5), shifted.
  const dvec3 at(0.25, 0.1, 1);
  EXPECT_NEAR(glm::dot(t.row[0], at), 0.425, 1e-12);
  EXPECT_NEAR(glm::dot(t.row[1], at), 0, 1e-12);
}

TEST_F(SceneTextures, CoordinatesOfAllTypes) {
  const std::vector<std::uint8_t> bytes = {0, 255, 51, 102, 255, 0};
  const std::vector<std::uint16_t> shorts = {0, 65535, 13107, 26214, 65535, 0};
  const std::vector<std::int8_t> quantized = {0, 127, -127, 64, 1, 2};
  const auto corner = [&](const std::string& values, int type, bool normalized, bool quantization) {
    Document document = textured(as_data_uri(four_colors));
    document.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
        document.accessor(values, type, 3, "VEC2", {{"normalized", normalized}});
    if (quantization) document.json["extensionsUsed"] = document.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    return dvec2(load(document).objects.at(0).coordinates.at(0)[1]);
  };
  EXPECT_LT(glm::length(corner(bytes_of(bytes), 5121, true, false) - dvec2(0.2, 0.4)), 1e-7);
  EXPECT_LT(glm::length(corner(bytes_of(shorts), 5123, true, false) - dvec2(0.2, 0.4)), 1e-7);
  EXPECT_LT(glm::length(corner(bytes_of(quantized), 5120, true, true) - dvec2(-1, 64 / 127.0)), 1e-7);
  EXPECT_LT(glm::length(corner(bytes_of(quantized), 5120, false, true) - dvec2(-127, 64)), 1e-7);
  Document document = textured(as_data_uri(four_colors));
  document.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
      document.accessor(bytes_of(bytes), 5121, 3, "VEC2");
  expect_error(document, {"accessor 2", "texture coordinates"});

  document = textured(as_data_uri(four_colors));
  const std::size_t base = document.json["accessors"].size() - 1;
  const int index = document.accessor(bytes_of(std::vector<std::uint32_t>{1}), 5125, 1, "SCALAR");
  const int value = document.accessor(bytes_of(std::vector<float>{5, 6}), 5126, 1, "VEC2");
  const auto view = [&](int accessor) { return document.json["accessors"][accessor]["bufferView"]; };
  document.json["accessors"][base]["sparse"] = {{"count", 1},
                                                {"indices", {{"bufferView", view(index)}, {"componentType", 5125}}},
                                                {"values", {{"bufferView", view(value)}}}};
  EXPECT_EQ(load(document).objects.at(0).coordinates.at(0)[1], glm::vec4(5, 6, 0, 0));
}

// Corners keep their coordinates when triangles are dropped and turned round.
TEST_F(SceneTextures, CoordinatesFollowTheirCorners) {
  Document document = triangle();
  document.json["accessors"] = Json::array();
  const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0};
  document.vec3(positions);
  document.json["meshes"][0]["primitives"][0]["indices"] = document.indices({0, 0, 1, 0, 1, 3, 1, 3, 2});
  document.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
      document.accessor(bytes_of(std::vector<float>{0, 0, 1, 0, 0, 1, 2, 0}), 5126, 4, "VEC2");
  document.json["images"] = Json::array({as_data_uri(four_colors)});
  document.json["textures"] = {{{"source", 0}}};
  document.json["materials"][0]["emissiveFactor"] = {1, 1, 1};
  document.json["materials"][0]["emissiveTexture"] = {{"index", 0}};
  for (const double mirror : {1, -1}) {
    document.json["nodes"][0]["scale"] = {mirror, 1, 1};
    const Scene scene = load(document);
    const Object& object = scene.objects.at(0);
    ASSERT_EQ(object.mesh.triangles.size(), 1u);
    ASSERT_EQ(object.coordinates.size(), 1u);
    for (int k = 0; k < 3; ++k) {
      const dvec3 position = object.mesh.positions[object.mesh.triangles[0][k]] + scene.origin;
      EXPECT_EQ(object.coordinates[0][k], glm::vec4(mirror * position.x, position.y, 0, 0));
    }
  }
}

TEST_F(SceneTextures, SaysWhatIsLeftOut) {
  Document document = textured(as_data_uri(four_colors));
  Json& material = document.json["materials"][0];
  material["occlusionTexture"] = {{"index", 0}};
  material["extensions"]["KHR_materials_transmission"] = {{"transmissionTexture", {{"index", 0}}}};
  document.json["extensionsUsed"] = {"KHR_materials_transmission"};
  Scene scene = load(document);
  EXPECT_EQ(count_warnings(scene, {"material \"stuff\"", "transmissionTexture"}), 1u);
  EXPECT_EQ(count_warnings(scene, {"occlusion"}), 0u);
  EXPECT_EQ(count_warnings(scene, {"baseColorTexture"}), 0u);

  material["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 2;
  scene = load(document);
  EXPECT_EQ(count_warnings(scene, {"baseColorTexture", "TEXCOORD_2"}), 1u);
  EXPECT_FALSE(scene.materials[0].base_color_texture);

  material["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 1;
  EXPECT_EQ(count_warnings(load(document), {"mesh \"shape\"", "TEXCOORD_1"}), 1u);

  material["extras"] = {{"meniscus_liquid", "water"}};
  scene = load(document);
  EXPECT_EQ(count_warnings(scene, {"baseColorTexture is ignored", "liquid"}), 1u);
  EXPECT_FALSE(has_textures(scene.materials[0]));
}

TEST_F(SceneTextures, RefusesWhatCannotBeRead) {
  expect_error(textured({{"uri", "missing.png"}}), {"image \"missing.png\"", "no such file"});
  expect_error(textured({{"uri", "../outside.png"}}), {"../outside.png", "leads out"});
  expect_error(textured(as_data_uri("GIF89a, as it were")), {"image 0", "neither PNG nor JPEG"});
  expect_error(textured(as_data_uri(four_colors.substr(0, 50))), {"image 0", "cannot be decoded"});
  std::string huge = png(1, 1, 1, {0});  // its header claims 30,000 x 30,000, then 65,536 x 65,536
  for (const std::size_t at : {16u, 20u}) huge.replace(at, 4, std::string("\0\0\x75\x30", 4));
  expect_error(textured(as_data_uri(huge)), {"image 0", "30000 x 30000 texels"});
  for (const std::size_t at : {16u, 20u}) huge.replace(at, 4, std::string("\0\1\0\0", 4));
  expect_error(textured(as_data_uri(huge)), {"image 0", "cannot be decoded", "billion"});

  Document document = textured(as_data_uri(four_colors));
  document.json["textures"][0]["source"] = 1;
  expect_error(document, {"texture 0", "image 1"});
  document.json["textures"][0] = {{"source", 0}, {"sampler", 0}};
  expect_error(document, {"texture 0", "sampler 0"});
  document.json["samplers"] = {{{"wrapS", 7}}};
  expect_error(document, {"sampler 0", "wrap mode 7"});
  document.json["samplers"] = Json::array({Json::object()});
  document.json["materials"][0]["normalTexture"] = {{"index", 3}};
  expect_error(document, {"material \"stuff\"", "texture 3"});
  document.json["materials"][0]["normalTexture"] = {
      {"index", 0}, {"extensions", {{"KHR_texture_transform", {{"scale", {1, 2, 3}}}}}}};
  document.json["extensionsUsed"] = {"KHR_texture_transform"};
  expect_error(document, {"normalTexture", "scale is not two numbers"});
}

}  // namespace
}  // namespace meniscal::testing

// Small glTF files, written by the test into a folder of its own.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "host/error.h"
#include "host/scene/scene.h"

namespace meniscal::testing {

using Json = nlohmann::json;

template <typename T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

inline std::string base64(const std::string& bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) result += i + k > bytes.size() ? '=' : digits[word >> (18 - 6 * k) & 63];
  }
  return result;
}

// A glTF document and the bytes of its buffer 0.
struct Document {
  Json json;
  std::string buffer;

  // Appends a buffer view and an accessor on it; returns the accessor's index.
  int accessor(const std::string& bytes, int component_type, std::size_t count, const std::string& type,
               Json more = {}) {
    while (buffer.size() % 4 != 0) buffer += '\0';
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}});
    buffer += bytes;
    Json accessor = {{"bufferView", json["bufferViews"].size() - 1},
                     {"componentType", component_type},
                     {"count", count},
                     {"type", type}};
    if (more.is_object()) accessor.update(more);
    json["accessors"].push_back(accessor);
    return static_cast<int>(json["accessors"].size()) - 1;
  }
  int vec3(const std::vector<float>& values) { return accessor(bytes_of(values), 5126, values.size() / 3, "VEC3"); }
  int indices(const std::vector<std::uint32_t>& values) {
    return accessor(bytes_of(values), 5125, values.size(), "SCALAR");
  }

  // The document with its buffer as a data URI.
  std::string text() const {
    Json complete = json;
    complete["buffers"] = Json::array(
        {{{"byteLength", buffer.size()}, {"uri", "data:application/octet-stream;base64," + base64(buffer)}}});
    return complete.dump();
  }
};

inline const std::vector<float> triangle_positions = {0, 0, 0, 1, 0, 0, 0, 1, 0};  // faces +Z

// One node "thing" with one triangle of material "stuff", no normals, no indices.
inline Document triangle() {
  Document document;
  document.json = {{"asset", {{"version", "2.0"}}},
                   {"scene", 0},
                   {"scenes", {{{"nodes", {0}}}}},
                   {"nodes", {{{"name", "thing"}, {"mesh", 0}}}},
                   {"materials", {{{"name", "stuff"}}}}};
  document.vec3(triangle_positions);
  document.json["meshes"] = {
      {{"name", "shape"}, {"primitives", {{{"attributes", {{"POSITION", 0}}}, {"material", 0}}}}}};
  return document;
}

class SceneFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "meniscal-scene-XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    root = pattern;
    folder = root / "asset";
    std::filesystem::create_directory(folder);
  }
  void TearDown() override { std::filesystem::remove_all(root); }

  std::string write(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return path.string();
  }
  Scene load(const std::string& bytes, const std::string& name = "scene.gltf") {
    return load_gltf(write(folder / name, bytes));
  }
  Scene load(const Document& document) { return load(document.text()); }

  // Loading fails with the scene's exit code and a message that has the file's name and each of `parts`.
  void expect_error(const std::string& bytes, const std::vector<std::string>& parts,
                    const std::string& name = "scene.gltf") {
    try {
      load(bytes, name);
      ADD_FAILURE() << "loaded, though expected to fail with: " << ::testing::PrintToString(parts);
    } catch (const Error& error) {
      EXPECT_EQ(error.code, ExitCode::scene);
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
      for (const std::string& part : parts)
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }
  void expect_error(const Document& document, const std::vector<std::string>& parts) {
    expect_error(document.text(), parts);
  }

  static std::size_t count_warnings(const Scene& scene, const std::vector<std::string>& parts) {
    return static_cast<std::size_t>(
        std::count_if(scene.warnings.begin(), scene.warnings.end(), [&](const std::string& warning) {
          return std::all_of(parts.begin(), parts.end(),
                             [&](const std::string& part) { return warning.find(part) != std::string::npos; });
        }));
  }

  std::filesystem::path root, folder;
};

inline glm::dvec3 facet_normal(const meniscus::TriangleMesh& mesh, std::size_t triangle) {
  const glm::uvec3 t = mesh.triangles[triangle];
  return glm::normalize(
      glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]));
}

#define EXPECT_NEAR3(a, b, tolerance)                              \
  EXPECT_LE(glm::length(glm::dvec3(a) - glm::dvec3(b)), tolerance) \
      << #a << " is " << (a).x << " " << (a).y << " " << (a).z

}  // namespace meniscal::testing

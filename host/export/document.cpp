#include "host/export/document.h"

#include <algorithm>
#include <string_view>

namespace meniscal::gltf {
namespace {

// Accessors are aligned to their components, of which the largest have four bytes.
void align(std::string& bytes) { bytes.resize((bytes.size() + 3) / 4 * 4, '\0'); }

template <class Item>
std::size_t add_view(Document& document, const std::vector<Item>& items) {
  align(document.bytes);
  document.json["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", document.bytes.size()}, {"byteLength", items.size() * sizeof(Item)}});
  document.bytes.append(reinterpret_cast<const char*>(items.data()), items.size() * sizeof(Item));
  return document.json["bufferViews"].size() - 1;
}

template <class Item>
std::size_t add_accessor(Document& document, const std::vector<Item>& items, int component, std::size_t count,
                         const char* type, int target) {
  const std::size_t view = add_view(document, items);
  document.json["bufferViews"][view]["target"] = target;
  document.json["accessors"].push_back(
      {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
  return document.json["accessors"].size() - 1;
}

std::vector<glm::vec3> as_float(const std::vector<glm::dvec3>& values) { return {values.begin(), values.end()}; }

std::size_t add_vectors(Document& document, const std::vector<glm::vec3>& values) {
  return add_accessor(document, values, TINYGLTF_COMPONENT_TYPE_FLOAT, values.size(), "VEC3",
                      TINYGLTF_TARGET_ARRAY_BUFFER);
}

OrderedJson triple(const glm::vec3& v) { return {v.x, v.y, v.z}; }

// The two kinds that glTF knows; others stay in their files.
const char* media_type(std::string_view image) {
  if (image.starts_with("\x89PNG")) return "image/png";
  if (image.starts_with("\xff\xd8\xff")) return "image/jpeg";
  return nullptr;
}

void take_in_images(Document& document, const tinygltf::Model& model) {
  for (std::size_t i = 0; i < model.images.size(); ++i) {
    if (model.images[i].uri.empty()) continue;  // in a buffer, or in the text
    const std::vector<unsigned char>& file = model.images[i].image;
    const char* type = media_type({reinterpret_cast<const char*>(file.data()), file.size()});
    if (type == nullptr) continue;
    OrderedJson& image = document.json["images"][i];
    if (!image.contains("name")) image["name"] = image["uri"];
    image.erase("uri");
    image["mimeType"] = type;
    image["bufferView"] = add_view(document, file);
  }
}

}  // namespace

Document open_document(const Source& source) {
  Document document{OrderedJson::parse(source.json), {}};
  document.json.erase("buffers");
  std::vector<std::size_t> begin;
  for (const tinygltf::Buffer& buffer : source.model.buffers) {
    align(document.bytes);
    begin.push_back(document.bytes.size());
    document.bytes.append(reinterpret_cast<const char*>(buffer.data.data()), buffer.data.size());
  }
  if (document.json.contains("bufferViews"))
    for (OrderedJson& view : document.json["bufferViews"]) {
      view["byteOffset"] = view.value("byteOffset", std::size_t{0}) + begin[view["buffer"].get<std::size_t>()];
      view["buffer"] = 0;
    }
  take_in_images(document, source.model);
  return document;
}

std::size_t add_positions(Document& document, const std::vector<glm::dvec3>& positions) {
  const std::vector<glm::vec3> values = as_float(positions);
  const std::size_t index = add_vectors(document, values);
  glm::vec3 low = values.front(), high = low;
  for (const glm::vec3& v : values) low = glm::min(low, v), high = glm::max(high, v);
  document.json["accessors"][index]["min"] = triple(low);
  document.json["accessors"][index]["max"] = triple(high);
  return index;
}

std::size_t add_normals(Document& document, const std::vector<glm::dvec3>& normals) {
  return add_vectors(document, as_float(normals));
}

std::size_t add_indices(Document& document, const std::vector<glm::uvec3>& triangles) {
  return add_accessor(document, triangles, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, 3 * triangles.size(), "SCALAR",
                      TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
}

}  // namespace meniscal::gltf

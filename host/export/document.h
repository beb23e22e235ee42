// A glTF document that is being changed: the JSON as it was read, nothing lost, and one buffer.
#pragma once

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "host/scene/source.h"

namespace meniscal::gltf {

using OrderedJson = nlohmann::ordered_json;

struct Document {
  OrderedJson json;   // its `buffers` are written with the container
  std::string bytes;  // of buffer 0, to which all buffer views refer
};

// With the bytes of all its files: buffers, and images of kinds that a glTF may hold.
Document open_document(const Source& source);

// Append an accessor with a buffer view of its own, and return its index.
std::size_t add_positions(Document& document, const std::vector<glm::dvec3>& positions);
std::size_t add_normals(Document& document, const std::vector<glm::dvec3>& normals);
std::size_t add_indices(Document& document, const std::vector<glm::uvec3>& triangles);

}  // namespace meniscal::gltf

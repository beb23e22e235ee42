// Reads accessors of a validated model (validate.h) as plain values; sparse and quantised ones included.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "host/scene/messages.h"

namespace meniscal::gltf {

// Bytes of one component; 0 for a type glTF does not know.
std::uint64_t component_bytes(int component_type);
// Bytes of one element, without padding.
std::uint64_t element_bytes(const tinygltf::Accessor& accessor);

// Three numbers an element, in file units; normalised integers become [-1, 1] or [0, 1] (glTF 2.0, 3.6.2.2).
// Fails where the type is not VEC3, the component type is none that positions (normals) may have, or a number is not
// finite. `quantized`: KHR_mesh_quantization is in use and allows integers.
enum class Attribute { position, normal };
std::vector<glm::dvec3> read_vec3(const tinygltf::Model& model, int accessor, Attribute attribute, bool quantized,
                                  const Messages& messages);

// Texture coordinates, likewise; those that are not finite become 0.
std::vector<glm::dvec2> read_coordinates(const tinygltf::Model& model, int accessor, bool quantized,
                                         const Messages& messages);

// Vertex indices; fails where one is not below `vertices`.
std::vector<std::uint32_t> read_indices(const tinygltf::Model& model, int accessor, std::size_t vertices,
                                        const Messages& messages);

}  // namespace meniscal::gltf

#include "host/scene/meshes.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/scene/accessor.h"
#include "host/scene/geometry.h"
#include "host/scene/textures.h"

namespace meniscal::gltf {
namespace {

using meniscus::TriangleMesh;

// Those that the material's textures read; where the primitive has none, they read one place.
std::vector<glm::vec4> read_texture_coordinates(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                                std::size_t vertices, const std::vector<Material>& materials,
                                                const std::string& object, bool quantized, Messages& messages) {
  if (primitive.material < 0) return {};
  const Material& material = materials[static_cast<std::size_t>(primitive.material)];
  std::vector<glm::vec4> result;
  for (const int set : {0, 1}) {
    if (!reads_set(material, set)) continue;
    result.resize(vertices, glm::vec4(0));
    const std::string name = fmt::format("TEXCOORD_{}", set);
    const auto attribute = primitive.attributes.find(name);
    if (attribute == primitive.attributes.end()) {
      messages.warn(object, fmt::format("has no {}, which textures of material \"{}\" ask for: they are read at (0, 0)",
                                        name, material.name));
      continue;
    }
    const std::vector<glm::dvec2> coordinates = read_coordinates(model, attribute->second, quantized, messages);
    for (std::size_t i = 0; i < vertices; ++i) {
      result[i][2 * set] = static_cast<float>(coordinates[i].x);
      result[i][2 * set + 1] = static_cast<float>(coordinates[i].y);
    }
  }
  return result;
}

MeshParts read_mesh(const tinygltf::Model& model, std::size_t index, bool quantized,
                    const std::vector<Material>& materials, Messages& messages) {
  const tinygltf::Mesh& source = model.meshes[index];
  const std::string object = label("mesh", source.name, index);
  MeshParts result;
  std::size_t dropped = 0;
  for (const tinygltf::Primitive& primitive : source.primitives) {
    const auto position = primitive.attributes.find("POSITION");
    const auto normal = primitive.attributes.find("NORMAL");
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES || position == primitive.attributes.end()) {
      messages.warn(object, "points, lines and primitives without positions are left out");
      continue;
    }
    TriangleMesh part;
    part.positions = read_vec3(model, position->second, Attribute::position, quantized, messages);
    if (normal != primitive.attributes.end())
      part.normals = read_vec3(model, normal->second, Attribute::normal, quantized, messages);
    std::vector<std::uint32_t> indices;
    if (primitive.indices >= 0)
      indices = read_indices(model, primitive.indices, part.positions.size(), messages);
    else
      for (std::uint32_t i = 0; i < part.positions.size(); ++i) indices.push_back(i);
    if (primitive.mode == TINYGLTF_MODE_TRIANGLES && indices.size() % 3 != 0)
      messages.fail(object, fmt::format("has {} indices, no multiple of 3", indices.size()), "repair the mesh");
    part.triangles = triangulate(indices, primitive.mode);
    dropped += drop_collapsed(part);
    result.coordinates.push_back(
        read_texture_coordinates(model, primitive, part.positions.size(), materials, object, quantized, messages));
    result.parts.push_back(std::move(part));
    result.materials.push_back(primitive.material);
    result.primitives.push_back(static_cast<int>(&primitive - source.primitives.data()));
  }
  result.closed = is_closed(result.parts);
  for (TriangleMesh& part : result.parts) dropped += drop_flat(part);
  if (dropped != 0) messages.warn(object, fmt::format("{} triangles without area dropped", dropped));
  return result;
}

// Vertices and indices of every placed primitive, instances counted each.
void check_size(const tinygltf::Model& model, const std::vector<PlacedNode>& nodes, const Messages& messages) {
  const auto count = [&](int accessor) { return model.accessors[static_cast<std::size_t>(accessor)].count; };
  std::uint64_t total = 0;
  for (const PlacedNode& placed : nodes) {
    const tinygltf::Node& node = model.nodes[static_cast<std::size_t>(placed.node)];
    if (node.mesh < 0) continue;
    for (const tinygltf::Primitive& primitive : model.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
      if (!primitive.attributes.empty()) total += count(primitive.attributes.begin()->second);  // all have one count
      if (primitive.indices >= 0) total += count(primitive.indices);
      if (total > max_vertices)  // counts are below 2^31 (schema): no overflow before this
        messages.fail(label("node", node.name, static_cast<std::size_t>(placed.node)),
                      fmt::format("brings the scene above {} vertices", max_vertices), "simplify the scene");
    }
  }
}

}  // namespace

std::vector<MeshParts> read_meshes(const tinygltf::Model& model, const std::vector<PlacedNode>& nodes,
                                   const std::vector<Material>& materials, Messages& messages) {
  check_size(model, nodes, messages);
  const auto& used = model.extensionsUsed;
  const bool quantized = std::find(used.begin(), used.end(), "KHR_mesh_quantization") != used.end();
  std::vector<char> needed(model.meshes.size(), 0);
  for (const PlacedNode& placed : nodes)
    if (const int mesh = model.nodes[static_cast<std::size_t>(placed.node)].mesh; mesh >= 0)
      needed[static_cast<std::size_t>(mesh)] = 1;
  std::vector<MeshParts> meshes(model.meshes.size());
  for (std::size_t i = 0; i < meshes.size(); ++i)
    if (needed[i]) meshes[i] = read_mesh(model, i, quantized, materials, messages);
  return meshes;
}

}  // namespace meniscal::gltf

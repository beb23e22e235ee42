// The meshes of the file, each read once, in their own coordinates.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <vector>

#include "host/scene/messages.h"
#include "host/scene/placement.h"
#include "host/scene/scene.h"
#include "meniscus/mesh.h"

namespace meniscal::gltf {

// A few numbers in a file may ask for any amount of geometry (instances, accessors without data): this much is served,
// 3 GiB of it.
inline constexpr std::uint64_t max_vertices = std::uint64_t{1} << 26;

// The triangle primitives of one mesh, without degenerate triangles.
struct MeshParts {
  std::vector<meniscus::TriangleMesh> parts;  // normals as in the file, empty where it has none
  std::vector<int> materials;                 // -1: glTF's default material
  std::vector<int> primitives;                // which of the file's each part is: points and lines are left out
  // By part and vertex, sets 0 (x, y) and 1 (z, w); empty where the part's material has no textures.
  std::vector<std::vector<glm::vec4>> coordinates;
  bool closed = false;
};

// By glTF's index; those that no placed node uses stay empty. Needs a validated model; fails at values that are none
// (accessor.h).
std::vector<MeshParts> read_meshes(const tinygltf::Model& model, const std::vector<PlacedNode>& nodes,
                                   const std::vector<Material>& materials, Messages& messages);

}  // namespace meniscal::gltf

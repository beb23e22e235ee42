// Mesh nodes as objects in world space, relative to the scene's local origin.
#pragma once

#include <tiny_gltf.h>

#include <glm/glm.hpp>
#include <limits>
#include <vector>

#include "host/scene/meshes.h"
#include "host/scene/messages.h"
#include "host/scene/placement.h"
#include "host/scene/scene.h"

namespace meniscal::gltf {

// Empty: low above high.
struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
};

// Of all triangles, in world space.
Box bounding_box(const tinygltf::Model& model, const std::vector<PlacedNode>& nodes,
                 const std::vector<MeshParts>& meshes);

// Where the local origin is best: see the definition. Needs a box that is not empty.
glm::dvec3 local_origin(const Box& box);

// The transform that ends at coordinates relative to `origin`.
glm::dmat4 relative_to(glm::dmat4 to_world, const glm::dvec3& origin);

// One object a triangle primitive and node. `materials` gets glTF's default material as its last one where an object
// has none.
std::vector<Object> place_objects(const tinygltf::Model& model, const std::vector<PlacedNode>& nodes,
                                  const std::vector<MeshParts>& meshes, const glm::dvec3& origin,
                                  std::vector<Material>& materials, Messages& messages);

}  // namespace meniscal::gltf

// The node hierarchy: where things stand, in double precision; cameras and lights as they stand there.
#pragma once

#include <tiny_gltf.h>

#include <glm/glm.hpp>
#include <vector>

#include "host/scene/messages.h"
#include "host/scene/scene.h"

namespace meniscal::gltf {

struct PlacedNode {
  int node;
  glm::dmat4 to_world;
};

// The nodes of the file's scene (its first where it names none, every root where it has none), in the order of the
// hierarchy. Needs a validated model.
std::vector<PlacedNode> place_nodes(const tinygltf::Model& model, const Messages& messages);

// Cameras and lights in world space, not yet relative to any origin. Scale does not matter to either.
std::vector<Camera> read_cameras(const tinygltf::Model& model, const std::vector<PlacedNode>& nodes,
                                 const Messages& messages);
std::vector<PunctualLight> read_lights(const tinygltf::Model& model, const std::vector<PlacedNode>& nodes,
                                       Messages& messages);

// Looks down at 45 degrees on a sphere round the box from `low` to `high`, all of it in view.
Camera default_camera(const glm::dvec3& low, const glm::dvec3& high);

}  // namespace meniscal::gltf

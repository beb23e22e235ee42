// Light from all directions round the scene, as an image.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/stages.h"

namespace tinygltf {
class Model;
}

namespace meniscal {

// Latitude and longitude: rows from +Y down to -Y, columns from -X by -Z, +X (the middle) and +Z: what Blender and
// three.js show in these places.
struct Environment {
  int width = 0, height = 0;
  std::vector<glm::vec3> radiance;  // row by row, the top row first; finite, not negative
  double rotation = 0;              // of the whole about +Y, radians
};

namespace gltf {

class AssetFolder;
class Messages;

// The image that the scene's extras name (`environment`, `environment_rotation`, `environment_strength`), if they do;
// `file`: the name.
std::optional<Environment> read_environment(const tinygltf::Model& model, AssetFolder& folder, Messages& messages,
                                            std::string& file, Stages& stages);

}  // namespace gltf
}  // namespace meniscal

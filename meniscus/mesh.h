// Triangle meshes as plain values: what the meniscus library takes and returns.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace meniscus {

// Positions in metres. `normals` holds one unit vector per position, or is empty where none are known.
// Triangles are counter-clockwise seen from the side their geometric normal points to (out of the volume; up for a
// sheet of liquid).
struct TriangleMesh {
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec3> normals;
  std::vector<glm::uvec3> triangles;
};

}  // namespace meniscus

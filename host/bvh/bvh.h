// Triangles -> a flat bounding volume hierarchy for the GPU and the reference path.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "shaders/shared/bvh_node.h"

namespace meniscal {

struct Triangle {
  glm::dvec3 a, b, c;  // metres, relative to Scene::origin
};

// Nodes lie depth first, the root at 0; each holds the boxes of its two children. See shaders/shared/bvh_node.h.
struct Bvh {
  std::vector<shared::BvhNode> nodes;  // never empty: without triangles, a root with two empty children
  std::vector<uint32_t> order;         // leaf reference -> triangle of the input; a permutation of all of them
  double sah_cost = 0;                 // expected nodes and triangles tested by a line through the scene's box
  uint32_t depth = 0;                  // inner nodes on the longest way down: what a traversal's trail must hold
};

// Surface-area heuristic over binned centres, on one thread: the same input gives the same tree.
// Where levels run short of max_depth, halving by count instead, which takes at most 26. Boxes are floats
// that contain the triangles, in double and as rounded to a float corner and two float edges. Throws
// Error(ExitCode::scene) for coordinates that are not finite or beyond 1e37, and for 2^27 triangles or more.
Bvh build_bvh(std::span<const Triangle> triangles, uint32_t max_depth = shared::BVH_MAX_DEPTH);

}  // namespace meniscal

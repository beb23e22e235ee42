// The hierarchy before it is flattened.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <glm/glm.hpp>
#include <limits>
#include <span>

#include "shaders/shared/bvh_node.h"

namespace meniscal {

struct Box {
  glm::vec3 min{std::numeric_limits<float>::infinity()};  // empty
  glm::vec3 max{-std::numeric_limits<float>::infinity()};
  void grow(const Box& other) {
    min = glm::min(min, other.min);
    max = glm::max(max, other.max);
  }
};

// A leaf where count > 0, else an inner node with two children.
struct TreeNode {
  std::array<Box, 2> box;
  std::array<const TreeNode*, 2> child{};
  uint32_t count = 0;
  std::array<uint32_t, shared::BVH_MAX_LEAF> triangles{};
};

// Owns the nodes; their addresses hold.
class TreeNodes {
 public:
  TreeNode* make() { return &nodes_.emplace_back(); }

 private:
  std::deque<TreeNode> nodes_;
};

// By surface-area heuristic, in leaves of at most BVH_MAX_LEAF triangles, at most max_depth inner nodes deep: where
// levels get scarce, by halving along the longest side of the centres. boxes: one a triangle, at least one, and at most
// BVH_MAX_LEAF << max_depth, else it is as deep as halving makes it.
const TreeNode* build_tree(std::span<const Box> boxes, uint32_t max_depth, TreeNodes& nodes);

}  // namespace meniscal

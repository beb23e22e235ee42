#include <algorithm>
#include <numeric>
#include <vector>

#include "host/bvh/tree.h"

namespace meniscal {
namespace {

struct Halving {
  std::span<const Box> boxes;
  TreeNodes& nodes;

  glm::vec3 centre(uint32_t i) const { return 0.5f * boxes[i].min + 0.5f * boxes[i].max; }

  Box bound(std::span<const uint32_t> items) const {
    Box box;
    for (const uint32_t i : items) box.grow(boxes[i]);
    return box;
  }

  const TreeNode* build(std::span<uint32_t> items) {
    TreeNode* const node = nodes.make();
    if (items.size() <= shared::BVH_MAX_LEAF) {
      node->count = static_cast<uint32_t>(items.size());
      std::ranges::copy(items, node->triangles.begin());
      return node;
    }
    Box centres;
    for (const uint32_t i : items) centres.grow({centre(i), centre(i)});
    const glm::vec3 size = centres.max - centres.min;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const size_t half = items.size() / 2;
    // The index breaks ties, so that coincident triangles split alike everywhere.
    std::ranges::nth_element(items, items.begin() + static_cast<std::ptrdiff_t>(half), {},
                             [&](uint32_t i) { return std::pair(centre(i)[axis], i); });
    const std::array halves{items.first(half), items.subspan(half)};
    for (size_t side = 0; side < 2; ++side) {
      node->box[side] = bound(halves[side]);
      node->child[side] = build(halves[side]);
    }
    return node;
  }
};

}  // namespace

const TreeNode* build_median_tree(std::span<const Box> boxes, TreeNodes& nodes) {
  std::vector<uint32_t> items(boxes.size());
  std::iota(items.begin(), items.end(), 0u);
  return Halving{boxes, nodes}.build(items);
}

}  // namespace meniscal

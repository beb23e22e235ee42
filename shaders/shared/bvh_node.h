// A node of the bounding volume hierarchy: the boxes of its two children and where they are. Compiled as GLSL and C++.
#ifndef MENISCAL_BVH_NODE_H
#define MENISCAL_BVH_NODE_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/glm.hpp>
namespace meniscal::shared {
using glm::vec4;
using uint = std::uint32_t;
#define BVH_CONSTANT inline constexpr uint
#else
#define BVH_CONSTANT const uint
#endif

// Boxes are a centre and half the size, which takes fewer operations to meet than two corners. The half size is larger by 2^-19, more
// than what float arithmetic on a ray that starts in or near the box can lose.
// References stand as uint bits in w of the first two vectors. As texels: rgba32f boxes or rgba32ui bits, 4 per node.
//   inner child:  index of its node
//   leaf:         BVH_LEAF | (count - 1) << 27 | first, triangles order[first], ..., order[first + count - 1]
//   no child:     BVH_EMPTY (its box is a point too far away for any ray)
struct BvhNode {
  vec4 child0_centre;     // w: reference of child 0
  vec4 child0_half_size;  // w: reference of child 1
  vec4 child1_centre;     // w: 0
  vec4 child1_half_size;  // w: 0
};

BVH_CONSTANT BVH_LEAF = 0x80000000u;
BVH_CONSTANT BVH_EMPTY = 0xFFFFFFFFu;
BVH_CONSTANT BVH_COUNT_SHIFT = 27u;
BVH_CONSTANT BVH_COUNT_MASK = 0xFu;
BVH_CONSTANT BVH_FIRST_MASK = 0x07FFFFFFu;
BVH_CONSTANT BVH_MAX_LEAF = 4u;    // triangles of a leaf, as built
BVH_CONSTANT BVH_MAX_DEPTH = 31u;  // inner nodes on the way to a leaf, at most: bits of a traversal's trail, but for the last
BVH_CONSTANT BVH_ROOT_LEVEL = 0x80000000u;  // the root's bit of the trail; its children's is the next lower one

#ifdef __cplusplus
static_assert(sizeof(BvhNode) == 64);
#undef BVH_CONSTANT
}  // namespace meniscal::shared
#endif

#endif

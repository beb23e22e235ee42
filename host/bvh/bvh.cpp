#include "host/bvh/bvh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include "host/bvh/tree.h"
#include "host/error.h"

namespace meniscal {
namespace {

using shared::BvhNode;

// The largest coordinate that leaves room for padding and for differences of coordinates.
constexpr double max_coordinate = 1e37;

// Float box around a triangle, with a margin of two ulps of the largest coordinate of each axis: tracers store a corner
// and two edges, rounded, and their hits may lie that far outside.
Box padded_box(const Triangle& triangle, size_t index) {
  const glm::dvec3 low = glm::min(triangle.a, glm::min(triangle.b, triangle.c));
  const glm::dvec3 high = glm::max(triangle.a, glm::max(triangle.b, triangle.c));
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const double size = std::max({std::abs(triangle.a[axis]), std::abs(triangle.b[axis]), std::abs(triangle.c[axis])});
    const double sum = triangle.a[axis] + triangle.b[axis] + triangle.c[axis];  // NaN and infinity survive it
    if (!std::isfinite(sum) || size > max_coordinate) {
      throw Error(ExitCode::scene,
                  "triangle " + std::to_string(index) +
                      " has a coordinate that is not finite or beyond 1e37 m; correct the mesh it comes from");
    }
    const double margin = std::ldexp(size, -22);
    // Rounding to float may move inward by half an ulp, a quarter of the margin: one step out undoes it.
    box.min[axis] = std::nextafter(static_cast<float>(low[axis] - margin), -INFINITY);
    box.max[axis] = std::nextafter(static_cast<float>(high[axis] + margin), INFINITY);
  }
  return box;
}

double half_area(const Box& box) {
  const glm::dvec3 size = glm::dvec3(box.max) - glm::dvec3(box.min);
  return size.x * size.y + size.y * size.z + size.z * size.x;
}

glm::vec3 centre(const Box& box) { return 0.5f * box.min + 0.5f * box.max; }

// Of a box around this centre that contains `box`, with the margin that BvhNode promises.
glm::vec3 half_size(const Box& box, const glm::vec3& centre) {
  const glm::dvec3 middle(centre);
  const glm::dvec3 half = glm::max(glm::dvec3(box.max) - middle, middle - glm::dvec3(box.min));
  return glm::vec3(half * (1 + std::ldexp(1.0, -19) + std::ldexp(1.0, -22)));  // the last for rounding to float
}

// Writes the tree depth first. Depth is bounded by the builders, so recursion is.
class Flattener {
 public:
  explicit Flattener(Bvh& bvh) : bvh_(bvh) {}

  // Returns the reference to what stands at `child`, whose box `box` is.
  uint32_t write(const TreeNode* child, const Box& box, uint32_t depth) {
    area_ += half_area(box) * std::max(child->count, 1u);
    if (child->count > 0) {
      const auto first = static_cast<uint32_t>(bvh_.order.size());
      bvh_.order.insert(bvh_.order.end(), child->triangles.begin(), child->triangles.begin() + child->count);
      return shared::BVH_LEAF | (child->count - 1) << shared::BVH_COUNT_SHIFT | first;
    }
    const auto index = static_cast<uint32_t>(bvh_.nodes.size());
    bvh_.nodes.emplace_back();
    bvh_.depth = std::max(bvh_.depth, depth);
    const uint32_t first = write(child->child[0], child->box[0], depth + 1);
    const uint32_t second = write(child->child[1], child->box[1], depth + 1);
    bvh_.nodes[index] = record(child->box[0], first, child->box[1], second);
    return index;
  }

  static BvhNode record(const Box& box0, uint32_t reference0, const Box& box1, uint32_t reference1) {
    const glm::vec3 centre0 = centre(box0), centre1 = centre(box1);
    return {glm::vec4(centre0, std::bit_cast<float>(reference0)),
            glm::vec4(half_size(box0, centre0), std::bit_cast<float>(reference1)), glm::vec4(centre1, 0),
            glm::vec4(half_size(box1, centre1), 0)};
  }

  double area() const { return area_; }

 private:
  Bvh& bvh_;
  double area_ = 0;  // of all records, as often as each holds
};

}  // namespace

Bvh build_bvh(std::span<const Triangle> triangles, uint32_t max_depth) {
  if (triangles.size() > shared::BVH_FIRST_MASK) {
    throw Error(ExitCode::scene, "the scene has " + std::to_string(triangles.size()) + " triangles, at most " +
                                     std::to_string(shared::BVH_FIRST_MASK) + " are possible; simplify its meshes");
  }
  constexpr float far = std::numeric_limits<float>::max();
  const Box nowhere{glm::vec3(far), glm::vec3(far)};

  std::vector<Box> boxes;
  boxes.reserve(triangles.size());
  Box all;
  for (size_t i = 0; i < triangles.size(); ++i) {
    boxes.push_back(padded_box(triangles[i], i));
    all.grow(boxes.back());
  }

  Bvh bvh;
  if (triangles.empty()) {
    bvh.nodes.push_back(Flattener::record(nowhere, shared::BVH_EMPTY, nowhere, shared::BVH_EMPTY));
    bvh.depth = 1;
    return bvh;
  }
  TreeNodes nodes;
  const TreeNode* root = build_tree(boxes, max_depth, nodes);

  bvh.order.reserve(triangles.size());
  Flattener flattener(bvh);
  if (root->count > 0) {  // a lone leaf hangs under a root with one child
    bvh.nodes.emplace_back();
    const uint32_t leaf = flattener.write(root, all, 1);
    bvh.nodes[0] = Flattener::record(all, leaf, nowhere, shared::BVH_EMPTY);
    bvh.depth = 1;
  } else {
    flattener.write(root, all, 1);
  }
  bvh.sah_cost = flattener.area() / half_area(all);
  return bvh;
}

}  // namespace meniscal

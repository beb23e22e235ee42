// A naive traversal of the hierarchy, brute force to compare it with, and the tree's promises, checked.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "host/bvh/bvh.h"

namespace meniscal::bvh_oracle {

using shared::BvhNode;

struct Ray {
  glm::vec3 origin, direction;
};

struct Hit {
  float t;
  uint32_t triangle;
  bool operator==(const Hit&) const = default;
};

struct Counts {
  size_t nodes = 0, triangles = 0;
};

inline uint32_t reference(const BvhNode& node, int child) {
  return std::bit_cast<uint32_t>(child == 0 ? node.child0_centre.w : node.child0_half_size.w);
}
inline glm::vec3 centre(const BvhNode& node, int child) {
  return glm::vec3(child == 0 ? node.child0_centre : node.child1_centre);
}
inline glm::vec3 half_size(const BvhNode& node, int child) {
  return glm::vec3(child == 0 ? node.child0_half_size : node.child1_half_size);
}
// The box without the margin that its half size promises.
inline glm::dvec3 low(const BvhNode& node, int child) {
  return glm::dvec3(centre(node, child)) - glm::dvec3(half_size(node, child)) / (1 + std::ldexp(1.0, -19));
}
inline glm::dvec3 high(const BvhNode& node, int child) {
  return glm::dvec3(centre(node, child)) + glm::dvec3(half_size(node, child)) / (1 + std::ldexp(1.0, -19));
}
inline uint32_t leaf_first(uint32_t leaf) { return leaf & shared::BVH_FIRST_MASK; }
inline uint32_t leaf_count(uint32_t leaf) { return (leaf >> shared::BVH_COUNT_SHIFT & shared::BVH_COUNT_MASK) + 1; }

// Moeller and Trumbore's test in float, as the shaders do it.
inline std::optional<float> intersect(const Ray& ray, const Triangle& triangle) {
  const glm::vec3 a(triangle.a), ab(triangle.b - triangle.a), ac(triangle.c - triangle.a);
  const glm::vec3 p = glm::cross(ray.direction, ac), s = ray.origin - a, q = glm::cross(s, ab);
  const float inverse = 1 / glm::dot(ab, p);
  const float u = glm::dot(s, p) * inverse, v = glm::dot(ray.direction, q) * inverse, t = glm::dot(ac, q) * inverse;
  if (u >= 0 && v >= 0 && u + v <= 1 && t > 0 && std::isfinite(t)) return t;
  return std::nullopt;
}

// Ties in t go to the lower index: a choice that does not hang on the order of tests.
inline void keep_nearer(std::optional<Hit>& best, std::optional<float> t, uint32_t triangle) {
  if (t && (!best || *t < best->t || (*t == best->t && triangle < best->triangle))) best = Hit{*t, triangle};
}

inline std::optional<Hit> brute_force(const std::vector<Triangle>& triangles, const Ray& ray) {
  std::optional<Hit> best;
  for (uint32_t i = 0; i < triangles.size(); ++i) keep_nearer(best, intersect(ray, triangles[i]), i);
  return best;
}

// The slab test of the shaders: no special case for empty children.
inline std::optional<float> enter_box(const glm::vec3& centre, const glm::vec3& half_size, const Ray& ray,
                                      float reach) {
  const auto divisor = [](float d) { return std::abs(d) < 1e-12f ? 1e-12f : d; };
  const glm::vec3 inverse(1 / divisor(ray.direction.x), 1 / divisor(ray.direction.y), 1 / divisor(ray.direction.z));
  const glm::vec3 middle = (centre - ray.origin) * inverse, half = half_size * glm::abs(inverse);
  const glm::vec3 enter = middle - half, leave = middle + half;
  const float near = std::max({enter.x, enter.y, enter.z, 0.0f});
  const float far = 1.000002f * std::min({leave.x, leave.y, leave.z, reach});
  return near <= far ? std::optional(near) : std::nullopt;
}

inline std::optional<Hit> traverse(const Bvh& bvh, const std::vector<Triangle>& triangles, const Ray& ray,
                                   Counts* counts = nullptr) {
  std::optional<Hit> best;
  std::vector<uint32_t> stack{0};
  while (!stack.empty()) {
    EXPECT_LE(stack.size(), bvh.depth + 1);
    const uint32_t top = stack.back();
    stack.pop_back();
    EXPECT_NE(top, shared::BVH_EMPTY) << "a ray met the box of no child";
    if (top == shared::BVH_EMPTY) continue;
    if (top & shared::BVH_LEAF) {
      for (uint32_t i = leaf_first(top); i < leaf_first(top) + leaf_count(top); ++i) {
        keep_nearer(best, intersect(ray, triangles[bvh.order[i]]), bvh.order[i]);
        if (counts) ++counts->triangles;
      }
      continue;
    }
    if (counts) ++counts->nodes;
    const BvhNode& node = bvh.nodes[top];
    const float reach = best ? best->t : 1e30f;
    std::optional<float> near[2];
    for (int child = 0; child < 2; ++child) {
      near[child] = enter_box(centre(node, child), half_size(node, child), ray, reach);
    }
    const int first = near[0] && near[1] && *near[1] < *near[0] ? 1 : 0;
    for (const int child : {1 - first, first}) {
      if (near[child]) stack.push_back(reference(node, child));
    }
  }
  return best;
}

// Everything that can be said of a tree without a ray. Returns the depth found.
inline uint32_t check_subtree(const Bvh& bvh, const std::vector<Triangle>& triangles, uint32_t index,
                              const glm::dvec3& outer_low, const glm::dvec3& outer_high, std::vector<int>& seen) {
  const BvhNode& node = bvh.nodes[index];
  uint32_t below = 0;
  for (int child = 0; child < 2; ++child) {
    const uint32_t ref = reference(node, child);
    if (ref == shared::BVH_EMPTY) continue;
    // A centre is rounded, so a box may stick out of the one around it; its triangles must not.
    const glm::dvec3 box_low = glm::max(outer_low, low(node, child)),
                     box_high = glm::min(outer_high, high(node, child));
    if (!(ref & shared::BVH_LEAF)) {
      EXPECT_GT(ref, index) << "depth first";
      below = std::max(below, check_subtree(bvh, triangles, ref, box_low, box_high, seen));
      continue;
    }
    EXPECT_LE(leaf_count(ref), shared::BVH_MAX_LEAF);
    for (uint32_t i = leaf_first(ref); i < leaf_first(ref) + leaf_count(ref); ++i) {
      const Triangle& t = triangles[bvh.order[i]];
      ++seen[bvh.order[i]];
      // As rounded by a tracer that stores a corner and two edges, and in double.
      const glm::vec3 a(t.a), ab(t.b - t.a), ac(t.c - t.a);
      for (const glm::dvec3& p : {t.a, t.b, t.c, glm::dvec3(a), glm::dvec3(a + ab), glm::dvec3(a + ac)}) {
        EXPECT_TRUE(glm::all(glm::greaterThan(p, box_low)) && glm::all(glm::lessThan(p, box_high)));
      }
    }
  }
  return below + 1;
}

inline void check_tree(const Bvh& bvh, const std::vector<Triangle>& triangles) {
  std::vector<int> seen(triangles.size());
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(check_subtree(bvh, triangles, 0, glm::dvec3(-infinity), glm::dvec3(infinity), seen), bvh.depth);
  EXPECT_TRUE(std::ranges::all_of(seen, [](int times) { return times == 1; })) << "each triangle in one leaf";
  EXPECT_EQ(bvh.order.size(), triangles.size());
  EXPECT_LE(bvh.depth, shared::BVH_MAX_DEPTH);
}

}  // namespace meniscal::bvh_oracle

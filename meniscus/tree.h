// Boxes, and a tree of boxes for finding what overlaps and what is near. Works in the plane too, with one coordinate
// left at 0.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

namespace meniscus {

struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};

  void add(const glm::dvec3& p) { low = glm::min(low, p), high = glm::max(high, p); }
  void add(const Box& b) { low = glm::min(low, b.low), high = glm::max(high, b.high); }
  Box grown(double by) const { return {low - by, high + by}; }
  bool overlaps(const Box& b) const {
    return glm::all(glm::lessThanEqual(low, b.high)) && glm::all(glm::lessThanEqual(b.low, high));
  }
  double distance(const glm::dvec3& p) const { return glm::length(glm::max(glm::max(low - p, p - high), 0.0)); }
};

class Tree {
 public:
  explicit Tree(std::vector<Box> boxes);

  // Of all boxes.
  Box bounds() const { return nodes_.empty() ? Box{} : nodes_[0].box; }

  // Calls leaf(index) for every box that overlaps `box`.
  template <class Leaf>
  void overlapping(const Box& box, Leaf leaf) const {
    if (nodes_.empty()) return;
    std::array<std::uint32_t, 64> stack{0};  // one a level, and medians halve at most 32 times
    for (std::size_t size = 1; size > 0;) {
      const Node& node = nodes_[stack[--size]];
      if (!node.box.overlaps(box)) continue;
      if (node.count == 0) {
        stack[size++] = node.first + 1, stack[size++] = node.first;
      } else {
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
          if (boxes_[order_[i]].overlaps(box)) leaf(order_[i]);
        }
      }
    }
  }

  // Calls leaf(index) -> bound, near boxes first, for every box nearer to p than the bound that leaf returned last.
  template <class Leaf>
  void nearest(const glm::dvec3& p, double bound, Leaf leaf) const {
    if (!nodes_.empty() && nodes_[0].box.distance(p) <= bound) visit(0, p, bound, leaf);
  }

 private:
  struct Node {
    Box box;
    std::uint32_t first;  // of its entries in order_, or of its two children where count is 0
    std::uint32_t count;
  };

  void split(std::uint32_t node);

  template <class Leaf>
  void visit(std::uint32_t index, const glm::dvec3& p, double& bound, Leaf& leaf) const {
    const Node& node = nodes_[index];
    if (node.count == 0) {
      const double distance[2] = {nodes_[node.first].box.distance(p), nodes_[node.first + 1].box.distance(p)};
      const bool swap = distance[1] < distance[0];
      for (const bool second : {swap, !swap}) {
        if (distance[second] <= bound) visit(node.first + second, p, bound, leaf);
      }
      return;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (boxes_[order_[i]].distance(p) <= bound) bound = leaf(order_[i]);
    }
  }

  std::vector<Box> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace meniscus

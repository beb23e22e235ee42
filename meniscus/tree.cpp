#include "meniscus/tree.h"

#include <algorithm>
#include <numeric>

namespace meniscus {

Tree::Tree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  if (boxes_.empty()) return;
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.reserve(boxes_.size());
  nodes_.push_back({Box{}, 0, static_cast<std::uint32_t>(boxes_.size())});
  split(0);
}

// Halves a node along the longest side of its centres' box, at the median, until at most four boxes are left.
void Tree::split(std::uint32_t index) {
  const std::uint32_t first = nodes_[index].first, count = nodes_[index].count;
  Box box, centres;
  for (std::uint32_t i = first; i < first + count; ++i) {
    const Box& b = boxes_[order_[i]];
    box.add(b);
    centres.add(b.low + b.high);
  }
  nodes_[index].box = box;
  if (count <= 4) return;
  const glm::dvec3 size = centres.high - centres.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count, [&](std::uint32_t a, std::uint32_t b) {
    const double ca = boxes_[a].low[axis] + boxes_[a].high[axis], cb = boxes_[b].low[axis] + boxes_[b].high[axis];
    return ca < cb || (ca == cb && a < b);
  });
  const auto child = static_cast<std::uint32_t>(nodes_.size());
  nodes_[index].first = child, nodes_[index].count = 0;
  nodes_.push_back({Box{}, first, count / 2});
  nodes_.push_back({Box{}, first + count / 2, count - count / 2});
  split(child);
  split(child + 1);
}

}  // namespace meniscus

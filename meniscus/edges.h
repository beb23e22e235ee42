// A hash table from edges to values, with open addressing: for the millions of edges of a fine liquid.
#pragma once

#include <bit>
#include <vector>

#include "meniscus/topology.h"

namespace meniscus {

template <class Value>
class EdgeMap {
 public:
  // For at most `edges` different edges.
  explicit EdgeMap(std::size_t edges) : slots_(std::bit_ceil(2 * edges + 1)) {}

  // The value of an edge, a fresh one where it has none.
  Value& operator[](const Edge& edge) {
    Slot& slot = slots_[find(edge)];
    slot.edge = edge;
    return slot.value;
  }
  // Null where the edge has no value.
  const Value* get(const Edge& edge) const {
    const Slot& slot = slots_[find(edge)];
    return slot.edge == edge ? &slot.value : nullptr;
  }

 private:
  static constexpr Edge kEmpty{0xffffffff, 0xffffffff};
  struct Slot {
    Edge edge = kEmpty;
    Value value{};
  };
  std::size_t find(const Edge& edge) const {
    const std::uint64_t key = std::uint64_t{edge.first} << 32 | edge.second;
    const std::uint64_t mixed = key * 0x9e3779b97f4a7c15u;  // Fibonacci hashing
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = static_cast<std::size_t>(mixed ^ mixed >> 32) & mask;
    while (slots_[i].edge != edge && slots_[i].edge != kEmpty) i = (i + 1) & mask;
    return i;
  }
  std::vector<Slot> slots_;
};

// How many of the triangles have each edge.
template <class Weight>
EdgeMap<int> count_edges(const Topology& mesh, const std::vector<std::uint32_t>& triangles, Weight weight) {
  EdgeMap<int> uses(3 * triangles.size());
  for (const std::uint32_t t : triangles) {
    const glm::uvec3& v = mesh.triangles[t].points;
    for (int i = 0; i < 3; ++i) uses[edge(v[i], v[(i + 1) % 3])] += weight(t);
  }
  return uses;
}

}  // namespace meniscus

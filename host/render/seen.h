// Where the camera sees diffuse surfaces, coarsely.
#pragma once

#include <optional>
#include <span>
#include <unordered_set>
#include <vector>

#include "shaders/shared/structs.h"

namespace meniscal {

// Cells of several sizes around visible points: each at least as wide as two of the distances between it and its
// neighbours in the image.
class SeenCells {
 public:
  // `samples`: row by row, `width` a row. `least`: size of the smallest cells, m.
  SeenCells(std::span<const shared::PixelSample> samples, std::uint32_t width, double least = 0);
  // Whether a point is seen, or lies beside what is.
  bool contains(const glm::dvec3& point) const;
  bool empty() const { return levels_.empty(); }
  double widest() const { return levels_.back().size; }  // size of a cell, m; needs one

 private:
  struct Level {
    double size;  // of a cell, m
    std::unordered_set<std::uint64_t> cells;
  };
  std::vector<Level> levels_;  // narrowest first
};

}  // namespace meniscal

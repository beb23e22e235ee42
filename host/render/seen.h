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
  // `samples`: row by row, `width` a row.
  SeenCells(std::span<const shared::PixelSample> samples, std::uint32_t width);
  // Whether a point is seen, or lies beside what is.
  bool contains(const glm::dvec3& point) const;
  bool empty() const { return levels_.empty(); }

 private:
  struct Level {
    double size;  // of a cell, m
    std::unordered_set<std::uint64_t> cells;
  };
  std::vector<Level> levels_;
};

}  // namespace meniscal

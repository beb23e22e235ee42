// Which pixels see lights in menisci: a pass of its own looks at these alone.
#pragma once

#include "host/render/backend.h"

namespace meniscal {

// Lights that have highlights. Every cell asks each: of very many, areas are left to camera paths, or all lights.
struct Highlights {
  std::uint32_t lights;  // shared::HIGHLIGHTS_*
  std::string why;
};
Highlights find_highlights(const World& world);

// Collects the pixels of a crop whose camera paths met menisci, over the main views of a pass. A meniscus much thinner
// than a pixel may be missed by all paths of nine pixels: one of a tenth, by 16 a pixel, in 1 of 150 pixels; by one, in
// 3 of 4, which then lack its highlights.
class HighlightPixels {
 public:
  explicit HighlightPixels(const Crop& crop) : width_(crop.width()), met_(crop.pixels()) {}
  void add(const std::vector<shared::PixelSample>& samples);
  // These and those beside them, whose paths may have missed a meniscus by less than a pixel; row by row.
  std::vector<std::uint32_t> pixels() const;

 private:
  std::size_t width_;
  std::vector<bool> met_;
};

}  // namespace meniscal

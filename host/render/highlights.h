// Which pixels see lights in menisci: a pass of its own looks at these alone.
#pragma once

#include "host/render/backend.h"

namespace meniscal {

// Lights that have highlights: shared::HIGHLIGHTS_*. Areas of very many triangles are left to camera paths.
std::uint32_t find_highlights(const World& world);

// Collects the pixels of a crop whose camera paths met menisci, over the main views of a pass.
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

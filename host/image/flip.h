// FLIP: how different two pictures look to somebody who alternates between them. Andersson, Nilsson, Akenine-Moller,
// Oskarsson, Astrom and Fairchild, "FLIP: A Difference Evaluator for Alternating Images", Proc. ACM Comput. Graph.
// Interact. Tech. 3, 2 (2020); sections and constants as there.
#pragma once

#include <cstdint>
#include <vector>

namespace meniscal {

// Pixels a degree of vision of one who sits 0.7 m before a screen 0.7 m wide of 3840 pixels.
constexpr double flip_pixels_per_degree = 67;

struct Flip {
  double mean = 0;            // over the pixels: what "the FLIP of two pictures" is
  std::vector<float> pixels;  // row by row, [0, 1]
};

// Of two pictures of interleaved 8-bit sRGB, 3 * width * height bytes each. Symmetric; 0 where they are equal.
Flip flip(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b, int width, int height,
          double pixels_per_degree = flip_pixels_per_degree);

}  // namespace meniscal

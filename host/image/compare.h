// How far two images are from each other, layer by layer.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "host/image/layers.h"

namespace meniscal {

// A against the reference B over all samples (pixel and channel) that are finite in both; channels that only one has
// are left out.
struct LayerDifference {
  std::string layer;                  // "" is the beauty
  std::vector<std::string> channels;  // compared
  double rmse = 0;                    // sqrt(mean (A - B)^2)
  double relative_rmse = 0;           // rmse / sqrt(mean B^2); 0 where both are black, infinite where B alone is
  double mean_ratio = 1;              // mean A / mean B, 1 where both are 0
  double max_difference = 0;          // greatest |A - B|
  int max_x = 0, max_y = 0;           // its pixel, in the display window
  std::string max_channel;
  std::size_t samples = 0;     // finite in both
  std::size_t non_finite = 0;  // left out: NaN or infinite in A or B
};

// One entry per layer that both images have, the beauty first. Throws Error(ExitCode::scene) where the images' windows
// differ or no channel is common; `name_a` and `name_b` are for that message.
std::vector<LayerDifference> compare(const Image& a, const std::string& name_a, const Image& b,
                                     const std::string& name_b);

}  // namespace meniscal

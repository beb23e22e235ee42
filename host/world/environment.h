// The environment as it is sampled: by radiance times solid angle.
#pragma once

#include <vector>

#include "host/scene/environment.h"

namespace meniscal {

// Directions are taken in proportion to their light, uniform in each pixel; those of pixels too dark for the units of
// the CDF never.
struct SampledEnvironment {
  std::uint32_t columns = 0, rows = 0;  // 0: none
  double turn = 0;                      // about +Y, of a full circle, in [0, 1)
  std::vector<glm::vec4> pixels;        // radiance, and the density of directions there, 1/sr
  std::uint32_t first = 0;              // where the CDF of the rows begins, after which each row's own follow
};

// Radiance over all directions, mean over the channels.
double light_of(const Environment& image);

// Of an image that is not black. Appends its CDFs to `cdf`.
SampledEnvironment make_environment(const Environment& image, std::vector<std::uint32_t>& cdf);

}  // namespace meniscal

#include "host/render/pass_sums.h"

#include <algorithm>
#include <cmath>

#include "host/render/backend.h"

namespace meniscal {
namespace {

// What discs blur goes with their area: in pass i they are (i + 1)^(-1/4) wide.
double blur_of(std::uint32_t pass) { return 1 / std::sqrt(pass + 1.0); }

}  // namespace

void PassSums::add(std::uint32_t pass, const std::vector<glm::dvec3>& image) {
  const double blur = blur_of(pass);
  Half& half = halves_[passes_ % 2];
  for (std::size_t i = 0; i < image.size(); ++i) {
    squares_[i] += image[i] * image[i];
    half.values[i] += image[i];
    half.blurred[i] += blur * image[i];
  }
  ++half.passes, half.blurs += blur, half.square_blurs += blur * blur;
  ++passes_;
}

glm::dvec3 PassSums::mean(std::size_t pixel) const {
  return (halves_[0].values[pixel] + halves_[1].values[pixel]) / double(std::max(passes_, 1u));
}

glm::dvec3 PassSums::variance(std::size_t pixel) const {
  if (passes_ < 2) return glm::dvec3(0);
  const double n = passes_;
  const glm::dvec3 m = mean(pixel);
  return glm::max((squares_[pixel] / n - m * m) / (n - 1), glm::dvec3(0));
}

glm::dvec3 PassSums::Half::slope(std::size_t pixel) const {
  return (blurred[pixel] - blurs / passes * values[pixel]) / (square_blurs - blurs * blurs / passes);
}

// The mean lies off by what pixels fall by from its blur to none. Squared slopes would count the passes' noise as blur;
// products of both halves' do not, on average.
double PassSums::error_estimate() const {
  if (passes_ < 2) return -1;
  const double blur = (halves_[0].blurs + halves_[1].blurs) / passes_;
  double noise = 0, off = 0, signal = 0;
  for (std::size_t i = 0; i < pixels(); ++i) {
    noise += mean_of(variance(i));
    if (passes_ >= 4) off += blur * blur * mean_of(halves_[0].slope(i) * halves_[1].slope(i));
    const glm::dvec3 m = mean(i);
    signal += mean_of(m * m);
  }
  return signal > 0 ? std::sqrt((noise + std::max(off, 0.0)) / signal) : 0;
}

}  // namespace meniscal

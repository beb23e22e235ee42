#include "host/render/pass_sums.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "host/render/backend.h"

namespace meniscal {
namespace {

// In pass i discs are (i + 1)^(-1/4) wide. What they blur goes with their width next to edges and with their area where
// light is smooth: measured in seven scenes, this power of passes was never off by more than a half.
double blur_of(std::uint32_t pass) { return std::pow(pass + 1.0, -0.45); }

// Of a quantity that is `measured` to a standard error, cannot be negative, and before was thought to be exponentially
// distributed about an `expected` mean: the mean afterwards, that of a normal distribution cut off at 0.
double mean_given(double measured, double error, double expected) {
  if (!(error > 0 && expected > 0)) return std::max(measured, 0.0);
  const double cut = error / expected - measured / error;    // standard deviations above the normal's mean
  if (cut > 10) return error * (1 - 2 / (cut * cut)) / cut;  // where the difference below would be one of rounding
  const double density = std::exp(-0.5 * cut * cut) / std::sqrt(2 * glm::pi<double>());
  return error * (density / (0.5 * std::erfc(cut / glm::root_two<double>())) - cut);
}

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

// Slopes of both halves are the same but for the passes' noise, and so is what is left of their difference: the
// standard error of the sum of their products. Discs spread a photon's noise over pixels: what differences have in
// common within blocks tells over how many.
double PassSums::slope_noise() const {
  struct Block {
    std::size_t pixels = 0;
    glm::dvec3 sum{0};
    double squares = 0;
  };
  constexpr std::size_t across = 8;
  const std::size_t edge = std::max<std::size_t>(1, width_ / across), columns = (width_ + edge - 1) / edge;
  std::vector<Block> blocks((pixels() / width_ + edge - 1) / edge * columns + columns);
  double common = 0, squares = 0;
  for (std::size_t i = 0; i < pixels(); ++i) {
    const glm::dvec3 difference = halves_[0].slope(i) - halves_[1].slope(i);
    Block& block = blocks[i / width_ / edge * columns + i % width_ / edge];
    ++block.pixels;
    block.sum += difference;
    block.squares += mean_of(difference * difference);
  }
  for (const Block& b : blocks) common += mean_of(b.sum * b.sum), squares += b.squares;
  double variance = 0;
  for (const Block& b : blocks)
    if (b.pixels > 0) variance += b.squares * b.squares / double(b.pixels);
  return 0.5 * std::sqrt(variance * std::max(1.0, common / squares));
}

// The mean lies off by what pixels fall by from its blur to none. Squared slopes would count the passes' noise as blur;
// products of both halves' do not, on average. Where they are lost in that noise, as over late passes, whose blur
// hardly varies, there is as much blur as is usual: by errors of five scenes, in pass 0 up to 14 times the variance of
// noise there, in most 1 to 8; and noise grows from pass to pass about as blur falls.
double PassSums::error_estimate() const {
  if (passes_ < 2) return -1;
  const double blur = (halves_[0].blurs + halves_[1].blurs) / passes_;
  double noise = 0, off = 0, signal = 0;
  for (std::size_t i = 0; i < pixels(); ++i) {
    noise += mean_of(variance(i));
    if (passes_ >= 4) off += mean_of(halves_[0].slope(i) * halves_[1].slope(i));
    const glm::dvec3 m = mean(i);
    signal += mean_of(m * m);
  }
  constexpr double usual = 6;
  if (passes_ >= 4) off = mean_given(off, slope_noise(), usual * noise * passes_ * blur);
  return signal > 0 ? std::sqrt((noise + blur * blur * off) / signal) : 0;
}

}  // namespace meniscal

// What is known of the beauty after some passes: its mean, how far passes stray from it, and how far it is from where
// the passes lead.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace meniscal {

class PassSums {
 public:
  // `width`: pixels of a row.
  PassSums(std::size_t pixels, std::size_t width)
      : width_(width), squares_(pixels), halves_{Half(pixels), Half(pixels)} {}

  void add(std::uint32_t pass, const std::vector<glm::dvec3>& image);

  std::uint32_t passes() const { return passes_; }
  std::size_t pixels() const { return squares_.size(); }
  glm::dvec3 mean(std::size_t pixel) const;

  // Of the mean, per channel, from the passes' spread; 0 for fewer than two.
  glm::dvec3 variance(std::size_t pixel) const;

  // Relative error of the mean, sqrt(sum of squared errors / sum of squares) over all pixels: noise, and the blur of
  // discs that have yet to shrink. Negative for fewer than two passes; of fewer than four, the noise alone.
  double error_estimate() const;

  template <class Archive>
  void exchange(Archive& archive) {
    archive(passes_);
    archive(squares_);
    for (Half& half : halves_) {
      for (double* number : {&half.passes, &half.blurs, &half.square_blurs}) archive(*number);
      archive(half.values);
      archive(half.blurred);
    }
  }

 private:
  // Every other pass: what two halves agree on is no noise.
  struct Half {
    explicit Half(std::size_t pixels) : values(pixels), blurred(pixels) {}
    double passes = 0, blurs = 0, square_blurs = 0;
    std::vector<glm::dvec3> values, blurred;    // of the passes; these times the pass' blur
    glm::dvec3 slope(std::size_t pixel) const;  // over the blur, by least squares
  };

  double slope_noise() const;

  std::size_t width_;
  std::uint32_t passes_ = 0;
  std::vector<glm::dvec3> squares_;
  std::array<Half, 2> halves_;
};

}  // namespace meniscal

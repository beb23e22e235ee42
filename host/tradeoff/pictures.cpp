#include "host/tradeoff/pictures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "host/base64.h"
#include "host/image/png.h"

namespace meniscal {
namespace {

std::vector<double> luminances(const Image& image) {
  const std::vector<float>& rgb = image.find("")->pixels;
  std::vector<double> result;
  for (std::size_t i = 0; i + 2 < rgb.size(); i += 3)
    result.push_back(0.2126 * double(rgb[i]) + 0.7152 * double(rgb[i + 1]) + 0.0722 * double(rgb[i + 2]));
  return result;
}

}  // namespace

std::vector<std::uint8_t> false_colours(const std::vector<float>& values) {
  constexpr std::array<std::array<double, 3>, 9> scale = {{{0, 0, 4},
                                                           {28, 16, 68},
                                                           {79, 18, 123},
                                                           {129, 37, 129},
                                                           {181, 54, 122},
                                                           {229, 80, 100},
                                                           {251, 135, 97},
                                                           {254, 194, 135},
                                                           {252, 253, 191}}};
  std::vector<std::uint8_t> bytes;
  for (const float v : values) {
    const double at = (v > 0 ? std::min(double(v), 1.0) : 0) * (scale.size() - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(at), scale.size() - 2);
    for (std::size_t k = 0; k < 3; ++k)
      bytes.push_back(
          static_cast<std::uint8_t>(std::lround(scale[i][k] + (at - double(i)) * (scale[i + 1][k] - scale[i][k]))));
  }
  return bytes;
}

std::vector<float> error_map(const Image& image, const Image& reference) {
  const std::vector<double> a = luminances(image), b = luminances(reference);
  double squares = 0;
  for (const double l : b) squares += l * l;
  const double rms = std::sqrt(squares / double(std::max<std::size_t>(b.size(), 1)));
  std::vector<float> map;
  for (std::size_t i = 0; i < b.size(); ++i) {
    const double part = std::abs(a[i] - b[i]) / rms;
    // NaN, of a black reference, is no error; an infinite one is the greatest.
    map.push_back(part > least_shown_error ? static_cast<float>(1 - std::log10(part) / std::log10(least_shown_error))
                                           : 0.0f);
  }
  return map;
}

std::vector<std::uint8_t> caustic_alone(const Reference& reference) {
  std::vector<std::uint8_t> bytes = reference.srgb();
  for (std::size_t i = 0; i < bytes.size(); ++i)
    if (!reference.caustic()[i / 3]) bytes[i] = static_cast<std::uint8_t>(bytes[i] / 5);
  return bytes;
}

std::string data_uri(const std::vector<std::uint8_t>& srgb, int width, int height) {
  return "data:image/png;base64," + base64(encode_png("picture", width, height, srgb));
}

}  // namespace meniscal

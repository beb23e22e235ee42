#include "host/image/tonemap.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace meniscal {
namespace {

// Floats reach 3e38: sums and products of them stay finite in double.
double luminance(const float* rgb) {
  return 0.2126 * static_cast<double>(rgb[0]) + 0.7152 * static_cast<double>(rgb[1]) +
         0.0722 * static_cast<double>(rgb[2]);
}

// The value that 99 % of the positive channel values do not exceed; 1 where there is none.
double automatic_white(const std::vector<float>& rgb) {
  std::vector<float> values;
  for (const float v : rgb)
    if (v > 0 && std::isfinite(v)) values.push_back(v);
  if (values.empty()) return 1;
  const auto rank = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) * 99 / 100);
  std::nth_element(values.begin(), rank, values.end());
  return static_cast<double>(*rank);
}

double operator_scale(const std::vector<float>& rgb, ToneMap operation, bool exposure_given) {
  switch (operation) {
    case ToneMap::ward:
      return ward_scale(log_average_luminance(rgb));
    case ToneMap::aces: {
      const double average = log_average_luminance(rgb);
      return average > 0 ? 0.18 / average : 1;  // middle grey
    }
    case ToneMap::linear:
      return exposure_given ? 1 : 1 / automatic_white(rgb);
  }
  return 1;
}

std::uint8_t quantize(double display) {
  return static_cast<std::uint8_t>(std::floor(255 * srgb_encode(display) + 0.5));
}

}  // namespace

double ward_scale(double adaptation, double display_maximum) {
  const double threshold_ratio = (1.219 + std::pow(display_maximum / 2, 0.4)) / (1.219 + std::pow(adaptation, 0.4));
  return std::pow(threshold_ratio, 2.5) / display_maximum;
}

double aces_curve(double x) {
  const double bounded = std::min(x, 1e6);  // past white; infinity would divide by itself
  return std::clamp(bounded * (2.51 * bounded + 0.03) / (bounded * (2.43 * bounded + 0.59) + 0.14), 0.0, 1.0);
}

double log_average_luminance(const std::vector<float>& rgb) {
  std::vector<double> positive;
  double sum = 0;
  for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) {
    const double l = luminance(&rgb[i]);
    if (!(l > 0) || !std::isfinite(l)) continue;
    positive.push_back(l);
    sum += l;
  }
  // What is black but for a last stray photon or rounding (1e-14 was met) would pull a mean of logarithms down without
  // limit.
  const double darkest = 1e-4 * sum / static_cast<double>(positive.size());
  double log_sum = 0;
  std::size_t count = 0;
  for (const double l : positive)
    if (l >= darkest) log_sum += std::log(l), ++count;
  return count > 0 ? std::exp(log_sum / static_cast<double>(count)) : 0;
}

double srgb_encode(double linear) {
  // Written so that NaN ends at 0.
  const double x = linear > 0 ? std::min(linear, 1.0) : 0.0;
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

std::vector<std::uint8_t> tone_map_like(const std::vector<float>& like, const std::vector<float>& rgb,
                                        ToneMap operation, std::optional<double> exposure) {
  const double scale = operator_scale(like, operation, exposure.has_value()) * std::exp2(exposure.value_or(0));
  std::vector<std::uint8_t> bytes(rgb.size());
  std::transform(rgb.begin(), rgb.end(), bytes.begin(), [&](float v) {
    const double positive = v > 0 ? static_cast<double>(v) : 0.0;  // NaN and negative values to 0
    const double display = scale * positive;
    return quantize(operation == ToneMap::aces ? aces_curve(display) : display);
  });
  return bytes;
}

std::vector<std::uint8_t> tone_map(const std::vector<float>& rgb, ToneMap operation, std::optional<double> exposure) {
  return tone_map_like(rgb, rgb, operation, exposure);
}

}  // namespace meniscal

#include "host/image/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/error.h"

namespace meniscal {
namespace {

std::string describe_window(const Image& image) {
  return fmt::format("{} x {} pixels at {},{}", image.width, image.height, image.x0, image.y0);
}

// 0/0 is no difference, not an unknown one.
double ratio(double a, double b, double of_zeros) {
  if (b != 0) return a / b;
  return a == 0 ? of_zeros : std::copysign(std::numeric_limits<double>::infinity(), a);
}

LayerDifference compare_layers(const Image& image, const Layer& a, const Layer& b) {
  LayerDifference result;
  result.layer = a.name;
  double squared_difference = 0, squared_b = 0, sum_a = 0, sum_b = 0, greatest = -1;
  for (std::size_t channel_a = 0; channel_a < a.channels.size(); ++channel_a) {
    const auto found = std::find(b.channels.begin(), b.channels.end(), a.channels[channel_a]);
    if (found == b.channels.end()) continue;
    result.channels.push_back(*found);
    const auto channel_b = static_cast<std::size_t>(found - b.channels.begin());
    for (std::size_t pixel = 0; pixel < image.pixel_count(); ++pixel) {
      const double x = static_cast<double>(a.pixels[pixel * a.channels.size() + channel_a]);
      const double y = static_cast<double>(b.pixels[pixel * b.channels.size() + channel_b]);
      if (!std::isfinite(x) || !std::isfinite(y)) {
        ++result.non_finite;
        continue;
      }
      ++result.samples;
      squared_difference += (x - y) * (x - y), squared_b += y * y;
      sum_a += x, sum_b += y;
      if (std::abs(x - y) > greatest) {
        greatest = std::abs(x - y);
        result.max_x = image.x0 + static_cast<int>(pixel % static_cast<std::size_t>(image.width));
        result.max_y = image.y0 + static_cast<int>(pixel / static_cast<std::size_t>(image.width));
        result.max_channel = *found;
      }
    }
  }
  if (result.samples == 0) return result;
  result.rmse = std::sqrt(squared_difference / static_cast<double>(result.samples));
  result.relative_rmse = ratio(std::sqrt(squared_difference), std::sqrt(squared_b), 0);
  result.mean_ratio = ratio(sum_a, sum_b, 1);
  result.max_difference = greatest;
  return result;
}

}  // namespace

std::vector<LayerDifference> compare(const Image& a, const std::string& name_a, const Image& b,
                                     const std::string& name_b) {
  if (a.width != b.width || a.height != b.height || a.x0 != b.x0 || a.y0 != b.y0)
    throw Error(ExitCode::scene, fmt::format("{} is {}, {} is {}; compare images of the same --resolution and --crop",
                                             name_a, describe_window(a), name_b, describe_window(b)));
  std::vector<LayerDifference> differences;
  for (const Layer& layer : a.layers)
    if (const Layer* other = b.find(layer.name)) {
      LayerDifference difference = compare_layers(a, layer, *other);
      if (!difference.channels.empty()) differences.push_back(std::move(difference));
    }
  if (differences.empty())
    throw Error(ExitCode::scene,
                fmt::format("{} and {} have no channel in common; compare images with the same --aov", name_a, name_b));
  return differences;
}

}  // namespace meniscal

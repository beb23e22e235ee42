#include "host/world/environment.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "host/world/cdf.h"

namespace meniscal {
namespace {

constexpr double pi = glm::pi<double>();

double mean(const glm::vec3& c) { return (double(c.x) + double(c.y) + double(c.z)) / 3; }

// Probability of the i-th of the entries that begin at `first`.
double probability(const std::vector<std::uint32_t>& cdf, std::size_t first, std::size_t i) {
  return (double(cdf[first + i]) - (i > 0 ? double(cdf[first + i - 1]) : 0)) * 0x1p-32;
}

// Of one of a row's pixels: the cosines of the row's two edges differ by 2 sin sin.
double solid_angle(const Environment& image, std::size_t row) {
  const double half = pi / (2 * image.height);
  return 2 * pi / image.width * 2 * std::sin(half) * std::sin(half * double(2 * row + 1));
}

// Radiance over a row's directions.
double light_of(const Environment& image, std::size_t row) {
  const auto columns = static_cast<std::size_t>(image.width);
  double sum = 0;
  for (std::size_t column = 0; column < columns; ++column) sum += mean(image.radiance[row * columns + column]);
  return sum * solid_angle(image, row);
}

}  // namespace

double light_of(const Environment& image) {
  double sum = 0;
  for (std::size_t row = 0; row < static_cast<std::size_t>(image.height); ++row) sum += light_of(image, row);
  return sum;
}

SampledEnvironment make_environment(const Environment& image, std::vector<std::uint32_t>& cdf) {
  const auto columns = static_cast<std::size_t>(image.width), rows = static_cast<std::size_t>(image.height);
  SampledEnvironment result;
  result.columns = static_cast<std::uint32_t>(columns), result.rows = static_cast<std::uint32_t>(rows);
  const double turns = image.rotation / (2 * pi);
  result.turn = turns - std::floor(turns);
  result.first = static_cast<std::uint32_t>(cdf.size());
  append_cdf(cdf, rows, [&](std::size_t row) { return light_of(image, row); });
  for (std::size_t row = 0; row < rows; ++row) {
    const std::size_t first = cdf.size();
    append_cdf(cdf, columns, [&](std::size_t column) { return mean(image.radiance[row * columns + column]); });
    const double of_row = probability(cdf, result.first, row) / solid_angle(image, row);
    for (std::size_t column = 0; column < columns; ++column)
      result.pixels.emplace_back(image.radiance[row * columns + column],
                                 static_cast<float>(of_row * probability(cdf, first, column)));
  }
  return result;
}

}  // namespace meniscal

#include "host/image/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <numeric>

namespace meniscal {
namespace {

using Plane = std::vector<double>;  // one channel

// Section 5: exponents of the colour and the feature difference; where what part of the greatest colour difference
// goes to; the width of the features, degrees.
constexpr double kColourExponent = 0.7, kFeatureExponent = 0.5;
constexpr double kKneeOf = 0.4, kKneeTo = 0.95;
constexpr double kFeatureWidth = 0.082;

double from_srgb(std::uint8_t byte) {
  const double v = byte / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

// Columns: X, Y, Z of red, green and blue; D65.
const glm::dmat3 kXyzOfRgb(10135552.0 / 24577794, 2613072.0 / 12288897, 1425312.0 / 73733382,  //
                           8788810.0 / 24577794, 8788810.0 / 12288897, 8788810.0 / 73733382,   //
                           4435075.0 / 24577794, 887015.0 / 12288897, 70074185.0 / 73733382);
const glm::dvec3 kWhite = kXyzOfRgb * glm::dvec3(1);

// The opponent space YCxCz, linear in XYZ: achromatic, red against green, blue against yellow.
glm::dvec3 opponent(const glm::dvec3& rgb) {
  const glm::dvec3 r = kXyzOfRgb * rgb / kWhite;
  return {116 * r.y - 16, 500 * (r.x - r.y), 200 * (r.y - r.z)};
}

glm::dvec3 rgb_of_opponent(const glm::dvec3& c) {
  static const glm::dmat3 inverse = glm::inverse(kXyzOfRgb);
  const double y = (c.x + 16) / 116;
  return inverse * (kWhite * glm::dvec3(y + c.y / 500, y, y - c.z / 200));
}

// CIE L*a*b*, whose hues count the less the darker they are (Hunt's effect; section 4.1.2).
glm::dvec3 hunt_lab(const glm::dvec3& rgb) {
  const auto f = [](double t) {
    constexpr double d = 6.0 / 29;
    return t > d * d * d ? std::cbrt(t) : t / (3 * d * d) + 4.0 / 29;
  };
  const glm::dvec3 r = kXyzOfRgb * rgb / kWhite;
  const double lightness = 116 * f(r.y) - 16;
  return {lightness, 0.01 * lightness * 500 * (f(r.x) - f(r.y)), 0.01 * lightness * 200 * (f(r.y) - f(r.z))};
}

// Abasi, Amani Tehran and Fairchild's distance for large differences.
double hyab(const glm::dvec3& a, const glm::dvec3& b) { return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

// Weights at -radius .. radius.
using Kernel = std::vector<double>;

template <class Weight>
Kernel kernel(int radius, const Weight& weight) {
  Kernel k;
  for (int i = -radius; i <= radius; ++i) k.push_back(weight(double(i)));
  return k;
}

// Beyond its edges a picture goes on as at the edge.
Plane convolve(const Plane& plane, int width, int height, const Kernel& across, const Kernel& down) {
  const auto along = [&](const Plane& from, const Kernel& k, bool vertical) {
    const int radius = static_cast<int>(k.size() / 2), last = (vertical ? height : width) - 1;
    Plane to(from.size());
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        double sum = 0;
        for (int i = -radius; i <= radius; ++i) {
          const int moved = std::clamp((vertical ? y : x) + i, 0, last);
          sum += k[i + radius] * from[vertical ? std::size_t(moved) * width + x : std::size_t(y) * width + moved];
        }
        to[std::size_t(y) * width + x] = sum;
      }
    return to;
  };
  return along(along(plane, across, false), down, true);
}

// What of a channel the eye resolves, table 1: in space the contrast sensitivity is a sum of Gaussians, of one factor a
// and one squared width b each, degrees^2.
struct Gaussian {
  double a, b;
};
Plane filter_contrast(const Plane& plane, int width, int height, const std::vector<Gaussian>& sensitivity, double ppd) {
  constexpr double pi = std::numbers::pi, widest = 0.04;
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(widest / (2 * pi * pi)) * ppd));
  double total = 0;
  Plane sum(plane.size(), 0);
  for (const auto& [a, b] : sensitivity) {
    const Kernel k = kernel(radius, [&, b = b](double i) { return std::exp(-pi * pi * i * i / (ppd * ppd * b)); });
    const double reach = std::accumulate(k.begin(), k.end(), 0.0), factor = a * std::sqrt(pi / b);
    const Plane part = convolve(plane, width, height, k, k);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += factor * part[i];
    total += factor * reach * reach;
  }
  for (double& v : sum) v /= total;
  return sum;
}

std::array<Plane, 3> opponent_planes(const std::vector<std::uint8_t>& srgb) {
  std::array<Plane, 3> planes;
  for (std::size_t i = 0; i + 2 < srgb.size(); i += 3) {
    const glm::dvec3 c = opponent({from_srgb(srgb[i]), from_srgb(srgb[i + 1]), from_srgb(srgb[i + 2])});
    for (int k = 0; k < 3; ++k) planes[k].push_back(c[k]);
  }
  return planes;
}

// The picture as the eye resolves it, in Hunt's L*a*b*.
std::vector<glm::dvec3> perceived(const std::array<Plane, 3>& planes, int width, int height, double ppd) {
  const std::vector<Gaussian> sensitivities[3] = {{{1, 0.0047}}, {{1, 0.0053}}, {{34.1, 0.04}, {13.5, 0.025}}};
  std::array<Plane, 3> seen;
  for (int k = 0; k < 3; ++k) seen[k] = filter_contrast(planes[k], width, height, sensitivities[k], ppd);
  std::vector<glm::dvec3> colours;
  for (std::size_t i = 0; i < seen[0].size(); ++i)
    colours.push_back(
        hunt_lab(glm::clamp(rgb_of_opponent({seen[0][i], seen[1][i], seen[2][i]}), glm::dvec3(0), glm::dvec3(1))));
  return colours;
}

// Section 4.1.4: to [0, 1], great differences, which all look great, into its last twentieth.
double spread(double difference) {
  static const double greatest = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), kColourExponent);
  const double p = std::pow(difference, kColourExponent), knee = kKneeOf * greatest;
  if (p < knee) return kKneeTo * p / knee;
  return std::min(kKneeTo + (1 - kKneeTo) * (p - knee) / (greatest - knee), 1.0);
}

// Section 4.2: strength of edges or points (first or second derivatives of Gaussians) of an achromatic picture.
Plane features(const Plane& grey, int width, int height, double ppd, bool points) {
  const double sd = 0.5 * kFeatureWidth * ppd;
  const int radius = static_cast<int>(std::ceil(3 * sd));
  const auto gauss = [&](double i) { return std::exp(-i * i / (2 * sd * sd)); };
  Kernel smooth = kernel(radius, gauss);
  const double total = std::accumulate(smooth.begin(), smooth.end(), 0.0);
  for (double& w : smooth) w /= total;
  Kernel derivative = kernel(radius, [&](double i) { return (points ? i * i / (sd * sd) - 1 : -i) * gauss(i); });
  double positive = 0, negative = 0;
  for (const double w : derivative) (w > 0 ? positive : negative) += std::abs(w);
  for (double& w : derivative) w /= w > 0 ? positive : negative;
  Plane strength = convolve(grey, width, height, derivative, smooth);
  const Plane down = convolve(grey, width, height, smooth, derivative);
  for (std::size_t i = 0; i < strength.size(); ++i) strength[i] = std::hypot(strength[i], down[i]);
  return strength;
}

Plane feature_difference(const Plane& a, const Plane& b, int width, int height, double ppd) {
  const auto normalized = [](Plane plane) {
    for (double& v : plane) v = (v + 16) / 116;
    return plane;
  };
  const Plane grey_a = normalized(a), grey_b = normalized(b);
  Plane greatest(a.size(), 0);
  for (const bool points : {false, true}) {
    const Plane of_a = features(grey_a, width, height, ppd, points),
                of_b = features(grey_b, width, height, ppd, points);
    for (std::size_t i = 0; i < greatest.size(); ++i) greatest[i] = std::max(greatest[i], std::abs(of_a[i] - of_b[i]));
  }
  for (double& v : greatest) v = std::min(std::pow(v / std::numbers::sqrt2, kFeatureExponent), 1.0);
  return greatest;
}

}  // namespace

Flip flip(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b, int width, int height,
          double pixels_per_degree) {
  const std::array<Plane, 3> planes_a = opponent_planes(a), planes_b = opponent_planes(b);
  const std::vector<glm::dvec3> seen_a = perceived(planes_a, width, height, pixels_per_degree),
                                seen_b = perceived(planes_b, width, height, pixels_per_degree);
  const Plane feature = feature_difference(planes_a[0], planes_b[0], width, height, pixels_per_degree);
  Flip result;
  for (std::size_t i = 0; i < seen_a.size(); ++i) {
    const double difference = std::pow(spread(hyab(seen_a[i], seen_b[i])), 1 - feature[i]);  // equation 13
    result.pixels.push_back(static_cast<float>(difference));
    result.mean += difference;
  }
  if (!seen_a.empty()) result.mean /= double(seen_a.size());
  return result;
}

}  // namespace meniscal

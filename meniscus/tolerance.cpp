#include "meniscus/tolerance.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "meniscus/predicates.h"
#include "meniscus/profile.h"

namespace meniscus {
namespace {

// Shares in the tolerances. A fifth is left for what columns move to end on the solid's own points.
struct Shares {
  double layers, columns;
};
constexpr Shares kHeight{0.135, 0.72}, kNormal{0.16, 0.64};
constexpr double kMostBend = glm::half_pi<double>() * glm::half_pi<double>();  // of the sine
constexpr double kSlack = 8;  // tolerances that a chord between columns may leave the solid by

}  // namespace

Error tolerance_for(const Liquid& liquid, double length, bool closed) {
  constexpr double kThin = 0.7, kMost = 12;  // capillary lengths; times
  const double radius = length / glm::two_pi<double>();
  const bool solved = liquid.profile == Profile::solved;  // its errors would grow with those of the whole
  const double thin = closed && !solved ? std::clamp(kThin * liquid.capillary_length / radius, 1.0, kMost) : 1;
  return {liquid.tolerance * thin * kHeightTolerance * liquid.capillary_length,
          liquid.tolerance * thin * glm::radians(kNormalTolerance)};
}

double Fineness::spacing(double d) const {
  if (profile == Profile::solved) return std::min(first + growth * d, layer);
  const Falloff fall = falloff(profile, d);
  const double slope = steepness * fall.slope;
  const double bent = fall.bend > kMostBend ? layer * std::sqrt(kMostBend / fall.bend) : layer;
  const double turning = steepness * std::abs(fall.jerk) / (1 + slope * slope);  // of normals: second derivative
  const double even = turning > 0 ? std::sqrt(8 * layer_normal / turning) : layer;
  return std::max(std::min(bent, even), layer * (kFinestLayer / kWidestLayer));
}

double Fineness::layers(double d) const {
  if (profile != Profile::solved) return d / layer;
  const double graded = std::clamp((layer - first) / growth, 0.0, d);
  return std::log1p(growth * graded / first) / growth + (d - graded) / layer;
}

double Fineness::turn_at(double radius) const {
  return std::min(turn, std::sqrt(8 * std::min(height.at(radius), normal.at(radius))));
}

Fineness Fineness::coarser(double factor) const {
  Fineness result = *this;
  const double square = factor * factor;
  result.layer *= factor, result.turn *= factor, result.first *= factor, result.growth *= factor;
  result.layer_normal *= square, result.error.height *= square, result.error.normal *= square;
  for (Bound* bound : {&result.height, &result.normal}) bound->inverse /= square, bound->per_metre /= square;
  return result;
}

Fineness find_fineness(const Error& tolerance, Profile profile, double sweep_length, double rise, double radius) {
  constexpr double kLeastLayer = 1.0 / 264, kMostLayer = 1.0 / 12, kMostTurn = 0.25;
  Fineness f;
  f.tolerance = tolerance;
  f.profile = profile, f.steepness = rise / sweep_length;
  // Along a chord the distance from the wall is less than at its ends, and the surface steeper.
  double steepest = 1 / kSlack, moment = 0;  // sine of the slope; times the distance
  double bent = 0, turned = 0;               // bend along the surface; slope and bend times the distance
  constexpr int kSamples = 64;
  for (int k = profile == Profile::circular ? 6 : 0; k <= kSamples; ++k) {
    const double d = (k - 1e-6) / kSamples;
    const Falloff fall = falloff(profile, std::max(d, 0.0));
    const double slope = std::abs(f.steepness * fall.slope), bend = f.steepness * fall.bend / sweep_length;
    const double square = 1 + slope * slope, sine = slope / std::sqrt(square), distance = d * sweep_length;
    steepest = std::max(steepest, sine), moment = std::max(moment, sine * distance);
    bent = std::max(bent, bend / square), turned = std::max(turned, (slope + bend * distance) / square);
  }
  const double by_height = kHeight.columns * tolerance.height, by_normal = kNormal.columns * tolerance.normal;
  f.layer = std::clamp(std::sqrt(8 * kHeight.layers * tolerance.height / (rise * kMostBend)), kLeastLayer, kMostLayer);
  if (profile == Profile::solved) {
    const double scale = std::sqrt(tolerance.normal / glm::radians(kNormalTolerance));
    constexpr double kFirst = 0.006, kOfRadius = 0.01, kGrowth = 0.1;  // capillary lengths; radii; per distance
    f.layer = scale * Fineness::kWidestSolved, f.growth = scale * kGrowth;
    f.first = scale * std::min(kFirst / kFar, kOfRadius * radius / sweep_length);
  }
  f.layer_normal = kNormal.layers * tolerance.normal;
  // No coarser round a low meniscus: the contact line itself is seen.
  f.turn = std::min(Fineness::kColumnTurn * std::sqrt(tolerance.normal / glm::radians(kNormalTolerance)), kMostTurn);
  f.height = {moment / by_height, steepest / by_height}, f.normal = {turned / by_normal, bent / by_normal};
  const double turn = f.turn_at(radius), sag = turn * turn / 8;
  f.error.height = f.layer * f.layer * rise * kMostBend / 8 + sag * (radius * steepest + moment);
  f.error.normal = f.layer_normal + sag * (radius * bent + turned);
  return f;
}

Fineness find_fineness(const Contour& contour, double contact_angle, const Liquid& liquid, double coarseness) {
  const std::size_t n = contour.points.size();
  double length = 0, area = 0, highest = 0;
  for (std::size_t i = 0; i + 1 < n + contour.closed; ++i) {
    const glm::dvec3 &a = contour.points[i].position, &b = contour.points[(i + 1) % n].position;
    length += glm::distance(a, b);
    area += cross(planar(a - contour.points[0].position), planar(b - a));
  }
  // About the curvature that the line will have: of a circle as long, with the liquid outside or inside.
  const double curvature = contour.closed ? -std::copysign(glm::two_pi<double>() / length, area) : 0;
  for (const ContourPoint& p : contour.points) {
    for (const glm::dvec3& normal : {p.before, p.after}) {
      const double beta = std::acos(glm::clamp(glm::dot(normal, p.liquid_normal), -1.0, 1.0));
      highest = std::max(highest, std::abs(rise(liquid, contact_angle, beta, curvature)));
    }
  }
  Error tolerance = tolerance_for(liquid, length, contour.closed);
  tolerance.height *= coarseness, tolerance.normal *= coarseness;
  return find_fineness(tolerance, liquid.profile, raised_length(liquid), highest, length / glm::two_pi<double>());
}

}  // namespace meniscus

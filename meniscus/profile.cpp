#include "meniscus/profile.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "meniscus/young_laplace.h"

namespace meniscus {
namespace {

Falloff sine(double d) {
  constexpr double k = glm::half_pi<double>();
  const double s = std::sin(k * d), c = std::cos(k * d);
  return {1 - s, -k * c, k * k * s, k * k * k * c};
}

// Where the exact profile is solved for: the sine, over a quarter of what is raised, as a start.
Falloff started(double d) {
  constexpr double k = kFar / 2;
  if (!(k * d < 1)) return {};
  const Falloff f = sine(k * d);
  return {f.height, k * f.slope, k * k * f.bend, k * k * k * f.jerk};
}

// A quarter of a circle that touches the wall and the level.
Falloff circular(double d) {
  const double from_wall = std::max(d, 1e-8), sagitta = std::sqrt(from_wall * (2 - from_wall));
  const double cube = sagitta * sagitta * sagitta;
  return {1 - std::sqrt(d * (2 - d)), -(1 - from_wall) / sagitta, 1 / cube,
          -3 * (1 - from_wall) / (cube * sagitta * sagitta)};
}

// The linearised Young-Laplace equation's solutions at distance d S = 2 d L: from a flat wall exp(-x / L), and K0(r /
// L) round a post of radius L.
Falloff decay(double d) {
  const double e = std::exp(-2 * d);
  return {e, -2 * e, 4 * e, -8 * e};
}
Falloff bessel(double d) {
  const double r = 1 + 2 * d, k0 = std::cyl_bessel_k(0, r), k1 = std::cyl_bessel_k(1, r);
  return {k0, -2 * k1, 4 * (k0 + k1 / r), -8 * (k1 + (k0 + 2 * k1 / r) / r)};
}

// Less the tangent at d = 1, so that it ends there without a crease, and 1 at d = 0.
template <Falloff (*function)(double)>
Falloff ended(double d) {
  static const Falloff start = function(0), end = function(1);
  static const double scale = 1 / (start.height - (end.height - end.slope));
  const Falloff f = function(d);
  return {scale * (f.height - (end.height + (d - 1) * end.slope)), scale * (f.slope - end.slope), scale * f.bend,
          scale * f.jerk};
}

}  // namespace

double sweep_length(const Liquid& liquid) {
  return 2 * liquid.capillary_length * (liquid.profile == Profile::solved ? 1 : liquid.sweep_scale);
}

double raised_length(const Liquid& liquid) {
  return liquid.profile == Profile::solved ? kFar * liquid.capillary_length : sweep_length(liquid);
}

double rise(const Liquid& liquid, double contact_angle, double beta, double curvature) {
  const double unit = liquid.height_scale * liquid.capillary_length, slope = beta - contact_angle;
  switch (liquid.profile == Profile::solved ? HeightRule::exact : liquid.height_rule) {
    case HeightRule::wetting:
      return 2 * unit * slope / glm::pi<double>();
    case HeightRule::equation2:
      return 2 * unit * (1 - contact_angle / glm::pi<double>());
    case HeightRule::exact:
      break;
  }
  return unit * exact_rise(slope, curvature * liquid.capillary_length);
}

Falloff falloff(Profile profile, double d) {
  if (!(d < 1)) return {};
  switch (profile) {
    case Profile::sine:
      return sine(d);
    case Profile::exponential:
      return ended<decay>(d);
    case Profile::circular:
      return circular(d);
    case Profile::solved:
      return started(d);
    case Profile::bessel:
      break;
  }
  return ended<bessel>(d);
}

}  // namespace meniscus

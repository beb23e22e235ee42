#include "meniscus/profile.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace meniscus {

double sweep_length(const Liquid& liquid) { return 2 * liquid.capillary_length * liquid.sweep_scale; }

double rise(const Liquid& liquid, double contact_angle, double beta) {
  const double alpha =
      liquid.height_rule == HeightRule::wetting ? glm::pi<double>() - (beta - contact_angle) : contact_angle;
  return 2 * liquid.capillary_length * (1 - alpha / glm::pi<double>()) * liquid.height_scale;
}

double profile(double d) { return d < 1 ? 1 - std::sin(glm::half_pi<double>() * d) : 0; }

double profile_slope(double d) { return d < 1 ? -glm::half_pi<double>() * std::cos(glm::half_pi<double>() * d) : 0; }

}  // namespace meniscus

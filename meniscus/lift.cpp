#include "meniscus/lift.h"

#include <algorithm>

#include "meniscus/predicates.h"
#include "meniscus/profile.h"

namespace meniscus {

Lifted lift(const Foot& foot, double sweep, Profile profile, const glm::dvec3& base, const glm::dvec3& up) {
  if (!foot.exists() || !(foot.distance < sweep)) return {base, up};
  const auto between = [&](auto Side::*value) {
    return foot.from->*value + foot.t * (foot.to->*value - foot.from->*value);
  };
  const auto in_liquid = [&](const glm::dvec2& v) { return tangent_to(up, v); };
  const Falloff fall = falloff(profile, foot.distance / sweep);
  const double rise = between(&Side::rise), height = fall.height, height_slope = fall.slope / sweep;
  const glm::dvec3 slide = in_liquid(between(&Side::slide));
  const glm::dvec3 out = glm::normalize(in_liquid(foot.direction)), forward = glm::cross(out, up);
  const double reach = between(&Side::reach);
  const bool fades = foot.distance < reach;
  const double fade = fades ? 1 - foot.distance / reach : 0, fade_slope = fades ? -1 / reach : 0;
  const glm::dvec3 toward = in_liquid(between(&Side::toward)), less = slide - toward;

  // Derivatives of the position along the contour (per metre of it; in a fan, per metre of arc) and across it.
  const double arc = std::max(foot.distance, 1e-6 * sweep);
  constexpr double kLeastStretch = 0.02;  // beyond the centre of a concave contour the columns would turn inside out
  const double stretch = foot.fan > 0 ? 1 : std::max(1 + between(&Side::curvature) * foot.distance, kLeastStretch);
  const double rise_slope =
      foot.fan > 0 ? (foot.to->rise - foot.from->rise) / (foot.fan * arc) : between(&Side::rise_slope);
  const glm::dvec2 slide_slope =
      foot.fan > 0 ? (foot.to->slide - foot.from->slide) / (foot.fan * arc) : between(&Side::slide_slope);
  const double fade_along = fades && foot.fan == 0 ? foot.distance / (reach * reach) * between(&Side::reach_slope) : 0;
  const glm::dvec2 toward_slope = foot.fan > 0 ? glm::dvec2(0) : between(&Side::toward_slope);
  const glm::dvec3 along = stretch * forward + in_liquid(fade * slide_slope + (1 - fade) * toward_slope) +
                           fade_along * less + rise_slope * height * up;
  const glm::dvec3 across = out + fade_slope * less + rise * height_slope * up;
  return {base + rise * height * up + toward + fade * less, glm::normalize(glm::cross(along, across))};
}

}  // namespace meniscus

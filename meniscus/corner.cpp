#include "meniscus/corner.h"

#include <cmath>
#include <iomanip>
#include <sstream>

namespace meniscus {
namespace {

constexpr double kRounded = 0.25;  // capillary lengths: nearer to a square corner water would stand 2 and more high

// Does the liquid stand within the angle between the sides?
bool inward(const Node& joint) {
  const glm::dvec2 d = joint.before.direction, forward{d.y, -d.x};
  return glm::dot(joint.after.direction, forward) < 0;
}

}  // namespace

std::vector<double> finite_angles(const ContactLine& line, double contact_angle, double capillary_length,
                                  const std::string& solid, Warnings& warnings) {
  std::vector<double> angles(line.nodes.size(), contact_angle);
  const double asked = std::cos(contact_angle), length = kRounded * capillary_length;
  double least = std::abs(asked);  // of the cosines that can be had
  for (std::size_t j = 0; j < angles.size(); ++j) {
    const Node& joint = line.nodes[j];
    if (!joint.joint || !inward(joint)) continue;
    const double most = 0.5 * glm::length(joint.before.solid_normal + joint.after.solid_normal);
    if (std::abs(asked) <= most) continue;
    least = std::min(least, most);
    angles[j] = std::acos(std::copysign(most, asked));
    for (const bool forward : {false, true}) {
      walk(line, j, forward, [&](std::size_t i, double way) {
        if (way > length || line.nodes[i].joint) return false;
        angles[i] = angles[j];
        return true;
      });
    }
  }
  if (least < std::abs(asked)) {
    std::ostringstream message;
    message << "solid '" << solid << "': in its corners the liquid would " << (asked > 0 ? "rise" : "sink")
            << " without bound; within " << std::setprecision(2) << 1e3 * length << " mm of them its contact angle is "
            << "taken to be " << std::setprecision(3) << glm::degrees(std::acos(std::copysign(least, asked)))
            << " degrees";
    warnings.push_back({message.str(), {line.solid}});
  }
  return angles;
}

}  // namespace meniscus

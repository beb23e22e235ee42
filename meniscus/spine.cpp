#include "meniscus/spine.h"

#include <algorithm>
#include <cmath>

#include "meniscus/predicates.h"

namespace meniscus {

glm::dvec2 find_lean(const std::vector<Strip>& strips) {
  glm::dmat2 square(0);
  glm::dvec2 side(0);
  for (const Strip& strip : strips) {
    const glm::dvec2 n = planar(strip.normal);
    square += strip.length * glm::outerProduct(n, n);
    side -= strip.length * strip.normal.y * n;
  }
  const double least = 1e-6 * (square[0][0] + square[1][1]);
  return least > 0 ? glm::inverse(square + glm::dmat2(least)) * side : glm::dvec2(0);
}

Spine::Spine(const ContactLine& line, const Body& body, double lowest, double highest)
    : below_(follow(line, body, lowest)), above_(follow(line, body, highest)) {}

Spine::Branch Spine::follow(const ContactLine& line, const Body& body, double end) {
  if (end == 0) return {};
  constexpr int kSteps = 8;
  Branch branch{end / kSteps, {}};
  std::vector<std::pair<glm::dvec3, glm::dvec3>> normals;  // of the solid before and after each node
  for (const Node& node : line.nodes) normals.emplace_back(node.before.solid_normal, node.after.solid_normal);
  glm::dvec2 shift(0);
  for (int k = 1; k <= kSteps; ++k) {
    std::vector<Strip> strips;
    for (std::size_t i = 0; i < line.segments(); ++i) {
      const double length = glm::distance(line.nodes[i].position, line.next(i).position);
      strips.push_back({length, normals[i].second});
      strips.push_back({length, normals[(i + 1) % normals.size()].first});
    }
    branch.shifts.push_back(shift += branch.step * find_lean(strips));
    if (k == kSteps) break;
    for (std::size_t i = 0; i < line.nodes.size(); ++i) {  // where no facet is met, the last one counts on
      const Node& node = line.nodes[i];
      const glm::dvec3 out = glm::normalize(tangent_to(node.liquid_normal, node.contact.direction));
      const double reach = 2 * std::abs(branch.step);
      const std::optional<Hit> hit = shoot(body, node.position + lifted(shift, k * branch.step), out, 0, reach);
      if (hit) normals[i] = {hit->normal, hit->normal};
    }
  }
  return branch;
}

glm::dvec3 Spine::at(double height, const glm::dvec3& up) const {
  if (height == 0) return glm::dvec3(0);
  const Branch& branch = height > 0 ? above_ : below_;
  glm::dvec3 way(0, height, 0);
  if (!branch.shifts.empty()) {
    const double steps = height / branch.step;
    const std::size_t k = std::min(static_cast<std::size_t>(steps), branch.shifts.size() - 1);
    const glm::dvec2 from = k == 0 ? glm::dvec2(0) : branch.shifts[k - 1];
    way += lifted(from + (steps - static_cast<double>(k)) * (branch.shifts[k] - from), 0);
  }
  return height / glm::dot(way, up) * way;
}

}  // namespace meniscus

#include "meniscus/snap.h"

#include <algorithm>
#include <map>
#include <sstream>

#include "meniscus/edges.h"
#include "meniscus/predicates.h"

namespace meniscus {

void snap_border(Topology& liquid, const std::vector<std::uint32_t>& surface, const std::string& name,
                 const std::vector<Body>& bodies, double tolerance, Warnings& warnings) {
  const EdgeMap<int> uses = count_edges(liquid, surface, [](std::uint32_t) { return 1; });
  std::map<std::uint32_t, std::vector<glm::dvec2>> outward;  // per point of the border: its edges' normals
  for (const std::uint32_t t : surface) {
    const glm::uvec3& v = liquid.triangles[t].points;
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = v[i], b = v[(i + 1) % 3];
      if (*uses.get(edge(a, b)) != 1) continue;
      const glm::dvec2 way = glm::normalize(planar(liquid.points[b]) - planar(liquid.points[a]));
      for (const std::uint32_t p : {a, b}) outward[p].push_back({way.y, -way.x});
    }
  }
  std::map<std::size_t, std::size_t> moved;  // points, by solid
  for (const auto& [p, across] : outward) {
    const std::vector<glm::dvec2>& normals = across;  // lambdas of clang 14 do not capture structured bindings
    if (normals.size() != 2) continue;
    const glm::dvec3 at = liquid.points[p];
    // As far from both edges; at sharp points no farther than four times as far.
    const glm::dvec2 miter = (normals[0] + normals[1]) / std::max(1 + glm::dot(normals[0], normals[1]), 0.25);
    const glm::dvec3 out = lifted(miter, 0);
    for (std::size_t s = 0; s < bodies.size(); ++s) {
      const Body& body = bodies[s];
      Box near;
      near.add(at);
      bool wall = false;
      body.tree.overlapping(near.grown(tolerance), [&](std::uint32_t t) {
        constexpr double kFacing = -0.5;  // cosine
        const glm::dvec3 n = glm::normalize(body.mesh.area_normal(t));
        const bool faces = std::any_of(normals.begin(), normals.end(),
                                       [&](const glm::dvec2& o) { return glm::dot(n, lifted(o, 0)) < kFacing; });
        wall = wall || (faces && glm::distance(nearest_on_triangle(body.mesh, t, at), at) <= tolerance);
      });
      if (!wall) continue;
      liquid.points[p] = at + 2 * tolerance * out;
      ++moved[s];
      break;
    }
  }
  for (const auto& [solid, count] : moved) {
    std::ostringstream message;
    message << "liquid '" << name << "': " << count << " points of its border lie within " << tolerance
            << " m of solid '" << bodies[solid].name << "': moved " << 2 * tolerance
            << " m outward, so that it reaches into the wall";
    warnings.push_back({message.str(), {solid}});
  }
}

}  // namespace meniscus

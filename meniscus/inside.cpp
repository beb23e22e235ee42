#include "meniscus/inside.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "meniscus/edges.h"
#include "meniscus/predicates.h"

namespace meniscus {
namespace {

constexpr std::uint32_t kNone = Triangulation::kNone;

// Of solids round a point, from their winding numbers.
struct Around {
  int count = 0;
  double doubt = 0;          // how far from whole numbers these are
  std::size_t doubtful = 0;  // the solid whose is farthest
};

Around solids_around(const std::vector<Body>& bodies, const glm::dvec3& p) {
  Around around;
  for (std::size_t s = 0; s < bodies.size(); ++s) {
    const double winding = winding_number(bodies[s].mesh, p), doubt = std::abs(winding - std::round(winding));
    around.count += static_cast<int>(std::lround(winding));
    if (doubt > around.doubt) around.doubt = doubt, around.doubtful = s;
  }
  return around;
}

}  // namespace

Winding find_windings(const Triangulation& mesh, const Patch& base, const std::vector<Body>& bodies,
                      Warnings& warnings) {
  constexpr int kUnknown = 1 << 30;
  const auto& triangles = mesh.triangles();
  Winding result{std::vector<int>(triangles.size(), kUnknown), std::vector<int>(triangles.size(), kUnknown)};
  const auto spread = [&](std::vector<int>& winding, std::uint32_t seed, int value, int Crossing::*kind,
                          auto&& passes) {
    std::vector<std::uint32_t> stack{seed}, reached{seed};
    winding[seed] = value;
    while (!stack.empty()) {
      const std::uint32_t t = stack.back();
      stack.pop_back();
      for (int i = 0; i < 3; ++i) {
        const std::uint32_t u = triangles[t].n[i];
        if (u == kNone || winding[u] != kUnknown) continue;
        int sense = 0;
        const Crossing* crossing = mesh.constraint(t, i, sense);
        if (!passes(u)) continue;
        winding[u] = winding[t] + (crossing ? sense * (crossing->*kind) : 0);
        stack.push_back(u);
        reached.push_back(u);
      }
    }
    return reached;
  };
  std::uint32_t outside = 0;
  while (std::find(triangles[outside].v.begin(), triangles[outside].v.end(), 0u) == triangles[outside].v.end())
    ++outside;
  spread(result.patch, outside, 0, &Crossing::patch, [](std::uint32_t) { return true; });

  const auto area = [&](std::uint32_t t) {
    const auto& v = triangles[t].v;
    return cross(mesh.points()[v[1]] - mesh.points()[v[0]], mesh.points()[v[2]] - mesh.points()[v[0]]);
  };
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (result.patch[t] <= 0 || result.solid[t] != kUnknown) continue;
    auto part = spread(result.solid, t, 0, &Crossing::solid, [&](std::uint32_t u) { return result.patch[u] > 0; });
    const std::size_t tries = std::min<std::size_t>(part.size(), 4);
    const auto larger = [&](std::uint32_t a, std::uint32_t b) { return std::pair(area(a), b) > std::pair(area(b), a); };
    std::partial_sort(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(tries), part.end(), larger);
    int shift = 0;
    Around best{0, 1, 0};
    for (std::size_t k = 0; k < tries && best.doubt > 0.25; ++k) {
      const auto& v = triangles[part[k]].v;
      const glm::dvec2 x = (mesh.points()[v[0]] + mesh.points()[v[1]] + mesh.points()[v[2]]) / 3.0;
      const Around around = solids_around(bodies, base.clamped(x).position);
      if (around.doubt < best.doubt) best = around, shift = around.count - result.solid[part[k]];
    }
    if (best.doubt > 0.25)
      warnings.push_back(
          {"solid '" + bodies[best.doubtful].name + "' is open: which side of it is liquid is a guess; close it",
           {best.doubtful}});
    for (const std::uint32_t u : part) result.solid[u] += shift;
  }
  return result;
}

std::vector<bool> find_drowned(const Topology& liquid, const std::vector<std::uint32_t>& surface, const Patch& patch,
                               const std::vector<Edge>& drowned_edges, const std::vector<Body>& bodies) {
  std::vector<bool> drowned(liquid.triangles.size(), false), seen(liquid.triangles.size(), false);
  std::vector<Box> boxes;
  for (const Body& body : bodies) {
    boxes.emplace_back();
    for (const glm::dvec3& p : body.mesh.points) boxes.back().add(p);
  }
  // The uses of each edge as a list: its last one as 3 * triangle + side + 1, and the one before each; 0 ends it.
  EdgeMap<std::uint32_t> last(3 * surface.size());
  std::vector<std::uint32_t> before(3 * liquid.triangles.size(), 0);
  EdgeMap<bool> patch_side(patch.border().size() + drowned_edges.size());  // of the patch's border: is it drowned?
  for (const std::uint32_t t : surface) {
    if (patch.contains(t)) continue;
    const glm::uvec3& v = liquid.triangles[t].points;
    for (std::uint32_t i = 0; i < 3; ++i) {
      std::uint32_t& use = last[edge(v[i], v[(i + 1) % 3])];
      before[3 * t + i] = use;
      use = 3 * t + i + 1;
    }
  }
  for (const Patch::Side& side : patch.border()) patch_side[edge(side.from, side.to)] = false;
  for (const Edge& e : drowned_edges) patch_side[e] = true;

  for (const std::uint32_t first : surface) {
    if (patch.contains(first) || seen[first]) continue;
    std::vector<std::uint32_t> part{first};
    seen[first] = true;
    std::optional<bool> answer;
    for (std::size_t k = 0; k < part.size(); ++k) {
      const glm::uvec3& v = liquid.triangles[part[k]].points;
      for (int i = 0; i < 3; ++i) {
        const Edge e = edge(v[i], v[(i + 1) % 3]);
        if (const bool* side = patch_side.get(e)) answer = answer.value_or(false) || *side;
        for (std::uint32_t use = last[e]; use != 0; use = before[use - 1]) {
          const std::uint32_t t = (use - 1) / 3;
          if (!seen[t]) part.push_back(t);
          seen[t] = true;
        }
      }
    }
    if (!answer) {
      const glm::dvec3 centre = (liquid.corner(first, 0) + liquid.corner(first, 1) + liquid.corner(first, 2)) / 3.0;
      Box point;
      point.add(centre);
      const bool near = std::any_of(boxes.begin(), boxes.end(), [&](const Box& b) { return b.overlaps(point); });
      answer = near && solids_around(bodies, centre).count > 0;
    }
    for (const std::uint32_t t : part) drowned[t] = *answer;
  }
  return drowned;
}

}  // namespace meniscus

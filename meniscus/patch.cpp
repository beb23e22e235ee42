#include "meniscus/patch.h"

#include <algorithm>

#include "meniscus/edges.h"
#include "meniscus/predicates.h"

namespace meniscus {
namespace {

glm::dvec3 flat(const glm::dvec2& p) { return {p.x, p.y, 0}; }
glm::dvec3 flat(const glm::dvec3& p) { return flat(planar(p)); }

double segment_distance(const glm::dvec2& x, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 e = b - a;
  const double t = glm::clamp(glm::dot(x - a, e) / glm::dot(e, e), 0.0, 1.0);
  return glm::distance(x, a + t * e);
}

// Barycentric coordinates in projection.
glm::dvec3 weights_at(const glm::dvec2& x, const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  const double area = cross(b - a, c - a);
  const double wb = cross(x - a, c - a) / area, wc = cross(b - a, x - a) / area;
  return {1 - wb - wc, wb, wc};
}

Box flat_box(const Topology& mesh, std::uint32_t t) {
  Box box;
  for (int i = 0; i < 3; ++i) box.add(flat(mesh.corner(t, i)));
  return box;
}

}  // namespace

Patch::Patch(const Topology& liquid, const std::vector<std::uint32_t>& surface, const std::vector<ContactLine>& lines,
             double reach)
    : liquid_(liquid), member_(liquid.triangles.size(), false), triangle_tree_({}), border_tree_({}) {
  std::vector<Box> boxes;
  std::vector<double> longest;
  for (const std::uint32_t t : surface) {
    const glm::dvec2 a = planar(liquid.corner(t, 0)), b = planar(liquid.corner(t, 1)), c = planar(liquid.corner(t, 2));
    longest.push_back(std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)}));
    boxes.push_back(flat_box(liquid, t).grown(longest.back()));
  }
  const Tree tree(std::move(boxes));
  for (const ContactLine& line : lines) {
    for (std::size_t i = 0; i < line.nodes.size(); ++i) {
      const glm::dvec2 p = planar(line.nodes[i].position);
      const double to_node = reach + 0.5 * glm::distance(p, planar(line.next(i).position));
      Box around;
      around.add(flat(p));
      tree.overlapping(around.grown(to_node), [&](std::uint32_t k) {
        const std::uint32_t t = surface[k];
        if (member_[t]) return;
        const double radius = to_node + longest[k];
        const glm::dvec2 a = planar(liquid.corner(t, 0)), b = planar(liquid.corner(t, 1)),
                         c = planar(liquid.corner(t, 2));
        const glm::dvec3 w = weights_at(p, a, b, c);
        const bool inside = w.x >= 0 && w.y >= 0 && w.z >= 0;
        member_[t] = inside || segment_distance(p, a, b) <= radius || segment_distance(p, b, c) <= radius ||
                     segment_distance(p, c, a) <= radius;
      });
    }
  }
  std::vector<Box> triangle_boxes, border_boxes;
  // By triangles of the free surface; those of the patch count two.
  const EdgeMap<int> uses = count_edges(liquid, surface, [&](std::uint32_t t) { return member_[t] ? 2 : 1; });
  for (const std::uint32_t t : surface) {
    if (!member_[t]) continue;
    triangles_.push_back(t);
    triangle_boxes.push_back(flat_box(liquid, t));
    box_.add(triangle_boxes.back());
    const glm::uvec3& v = liquid.triangles[t].points;
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = v[i], b = v[(i + 1) % 3];
      const int used = *uses.get(edge(a, b));
      if (used >= 4) continue;
      border_.push_back({a, b, used == 2});
      Box box;
      box.add(flat(liquid.points[a]));
      box.add(flat(liquid.points[b]));
      border_boxes.push_back(box);
    }
  }
  triangle_tree_ = Tree(std::move(triangle_boxes));
  border_tree_ = Tree(std::move(border_boxes));
}

Base Patch::interpolate(std::uint32_t t, const glm::dvec3& w, const glm::dvec2& x) const {
  const auto& n = liquid_.triangles[t].normals;
  const double y = liquid_.corner(t, 0).y;  // differences, so that a level liquid stays level to the last bit
  const double height = y + w.y * (liquid_.corner(t, 1).y - y) + w.z * (liquid_.corner(t, 2).y - y);
  return {lifted(x, height), glm::normalize(n[0] + w.y * (n[1] - n[0]) + w.z * (n[2] - n[0]))};
}

template <class Found>
void Patch::find(const glm::dvec2& x, Found found) const {
  bool done = false;
  Box point;
  point.add(flat(x));
  triangle_tree_.overlapping(point, [&](std::uint32_t k) {
    const std::uint32_t t = triangles_[k];
    const glm::dvec3 w =
        weights_at(x, planar(liquid_.corner(t, 0)), planar(liquid_.corner(t, 1)), planar(liquid_.corner(t, 2)));
    constexpr double kEdge = -1e-12;
    if (!done && w.x >= kEdge && w.y >= kEdge && w.z >= kEdge) found(t, w), done = true;
  });
}

std::optional<Base> Patch::at(const glm::dvec2& x) const {
  std::optional<Base> result;
  find(x, [&](std::uint32_t t, const glm::dvec3& w) { result = interpolate(t, w, x); });
  return result;
}

bool Patch::covers(const glm::dvec2& x) const {
  bool result = false;
  find(x, [&](std::uint32_t, const glm::dvec3&) { result = true; });
  return result;
}

Base Patch::clamped(const glm::dvec2& x) const {
  if (const auto base = at(x)) return *base;
  Base best{};
  double least = 1e300;
  triangle_tree_.nearest(flat(x), least, [&](std::uint32_t k) {
    const std::uint32_t t = triangles_[k];
    const glm::dvec2 a = planar(liquid_.corner(t, 0)), b = planar(liquid_.corner(t, 1)),
                     c = planar(liquid_.corner(t, 2));
    const double away = std::min({segment_distance(x, a, b), segment_distance(x, b, c), segment_distance(x, c, a)});
    if (away < least) {
      least = away;
      best = interpolate(t, weights_at(x, a, b, c), x);
    }
    return least;
  });
  return best;
}

bool Patch::border_within(const glm::dvec2& x, double limit) const {
  bool within = false;
  border_tree_.nearest(flat(x), limit, [&](std::uint32_t k) {
    const glm::dvec2 a = planar(liquid_.points[border_[k].from]), b = planar(liquid_.points[border_[k].to]);
    within = within || segment_distance(x, a, b) < limit;
    return within ? -1.0 : limit;
  });
  return within;
}

}  // namespace meniscus

#include "meniscus/contour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "meniscus/predicates.h"

namespace meniscus {
namespace {

// What makes a point of a contour: an edge of one mesh and the triangle of the other that it pierces.
struct Key {
  bool solid_edge;
  Edge edge;
  std::uint32_t triangle;
  auto operator<=>(const Key&) const = default;
};

struct Segment {
  std::uint32_t from, to;             // into the list of points
  glm::dvec3 normal_from, normal_to;  // of the solid
};

// Weights of the corners of a triangle at p, by areas along the triangle's normal.
glm::dvec3 barycentric(const Topology& mesh, std::uint32_t t, const glm::dvec3& p) {
  const glm::dvec3 a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
  const glm::dvec3 n = mesh.area_normal(t);
  const double total = glm::dot(n, n);
  if (total == 0) return {1, 0, 0};
  const double wb = glm::dot(glm::cross(p - a, c - a), n) / total, wc = glm::dot(glm::cross(b - a, p - a), n) / total;
  return {1 - wb - wc, wb, wc};
}

glm::dvec3 normal_at(const Topology& mesh, std::uint32_t t, const glm::dvec3& p) {
  const glm::dvec3 w = barycentric(mesh, t, p);
  const auto& n = mesh.triangles[t].normals;
  const glm::dvec3 sum = n[0] + w[1] * (n[1] - n[0]) + w[2] * (n[2] - n[0]);
  const double length = glm::length(sum);
  return length > 0 ? sum / length : n[0];
}

class Search {
 public:
  Search(const Topology& liquid, const Topology& solid, Shift shift) : liquid_(liquid), solid_(solid), shift_(shift) {}

  // Moeller's test, with signs alone.
  void pair(std::uint32_t f, std::uint32_t t) {
    const glm::dvec3 a[3] = {liquid_.corner(f, 0), liquid_.corner(f, 1), liquid_.corner(f, 2)};
    const glm::dvec3 p[3] = {solid_.corner(t, 0), solid_.corner(t, 1), solid_.corner(t, 2)};
    std::array<int, 3> above, before;
    for (int j = 0; j < 3; ++j) above[j] = shift_.solid_above_liquid(a, p[j]);
    if (above[0] == above[1] && above[1] == above[2]) return;
    for (int i = 0; i < 3; ++i) before[i] = shift_.liquid_before_solid(p, a[i]);
    if (before[0] == before[1] && before[1] == before[2]) return;
    int pass[3][3];  // [edge of the liquid][edge of the solid]
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) pass[i][j] = shift_.edges(a[i], a[(i + 1) % 3], p[j], p[(j + 1) % 3]);
    }
    std::optional<std::uint32_t> from, to;
    for (int j = 0; j < 3; ++j) {
      const int k = (j + 1) % 3;
      if (above[j] == above[k] || pass[0][j] != pass[1][j] || pass[1][j] != pass[2][j]) continue;
      const glm::uvec3& v = solid_.triangles[t].points;
      // Going up through the surface, counter-clockwise round an outward facet, begins the segment: liquid to its left.
      (above[j] < 0 ? from : to) = point({true, edge(v[j], v[k]), f}, f);
    }
    for (int i = 0; i < 3; ++i) {
      const int k = (i + 1) % 3;
      if (before[i] == before[k] || pass[i][0] != pass[i][1] || pass[i][1] != pass[i][2]) continue;
      const glm::uvec3& v = liquid_.triangles[f].points;
      (before[i] > 0 ? from : to) = point({false, edge(v[i], v[k]), t}, f);
    }
    if (!from || !to) return;  // only where one of the triangles has no area
    segments_.push_back(
        {*from, *to, normal_at(solid_, t, points_[*from].position), normal_at(solid_, t, points_[*to].position)});
  }

  const std::vector<Segment>& segments() const { return segments_; }
  const std::vector<ContourPoint>& points() const { return points_; }

 private:
  std::uint32_t point(const Key& key, std::uint32_t f) {
    const auto [entry, is_new] = known_.emplace(key, static_cast<std::uint32_t>(points_.size()));
    if (!is_new) return entry->second;
    const Topology& line = key.solid_edge ? solid_ : liquid_;
    const Topology& plane = key.solid_edge ? liquid_ : solid_;
    const glm::dvec3 p = line.points[key.edge.first], q = line.points[key.edge.second];
    const glm::dvec3 n = plane.area_normal(key.triangle), o = plane.corner(key.triangle, 0);
    const double dp = glm::dot(p - o, n), dq = glm::dot(q - o, n);
    const double t = dp == dq ? 0.5 : std::clamp(dp / (dp - dq), 0.0, 1.0);
    ContourPoint result{t == 1 ? q : p + t * (q - p), {}, {}, {}, {}};
    result.liquid_normal = normal_at(liquid_, f, result.position);
    if (!key.solid_edge) result.border = key.edge;
    points_.push_back(result);
    return entry->second;
  }

  const Topology& liquid_;
  const Topology& solid_;
  const Shift shift_;
  std::map<Key, std::uint32_t> known_;
  std::vector<ContourPoint> points_;
  std::vector<Segment> segments_;
};

// A solid that only stands on the level with a whole face wets it: it is shifted down, any other solid up.
Shift choose_shift(const std::vector<Body>& bodies, std::size_t s, const Box& surface, Warnings& warnings) {
  const Topology& solid = bodies[s].mesh;
  Box box;
  for (const glm::dvec3& p : solid.points) box.add(p);
  bool at_level = false, bottom = false;
  for (std::size_t t = 0; t < solid.triangles.size(); ++t) {
    const double y = solid.corner(t, 0).y;
    if (y != solid.corner(t, 1).y || y != solid.corner(t, 2).y) continue;
    if (y != surface.low.y || y != surface.high.y) continue;
    at_level = true;
    bottom = bottom || y == box.low.y;
  }
  if (at_level) {
    warnings.push_back({"solid '" + bodies[s].name +
                            "' has a face exactly at the level of the liquid: taken as wetted, moved " +
                            (bottom ? "down" : "up") + " by an infinitesimal amount",
                        {s}});
  }
  return {bottom ? -1 : 1};
}

// Does a closed contour part anything, seen from above? Not where the solid touches the liquid in a point or an edge,
// or is a sheet with two sides in one place.
bool encloses(const Contour& contour) {
  constexpr double kThin = 1e-9;  // of a square as far round
  const glm::dvec2 first = planar(contour.points.front().position);
  double around = 0, area = 0;
  for (std::size_t i = 0; i < contour.points.size(); ++i) {
    const glm::dvec2 a = planar(contour.points[i].position) - first;
    const glm::dvec2 b = planar(contour.points[(i + 1) % contour.points.size()].position) - first;
    around += glm::distance(a, b), area += 0.5 * cross(a, b);
  }
  return std::abs(area) > kThin * around * around / 16;
}

// Does this edge bound the free surface: is it of one of its triangles only?
bool is_border(const Topology& liquid, const std::vector<std::uint32_t>& surface, const Tree& tree, const Edge& e) {
  Box box;
  box.add(liquid.points[e.first]);
  box.add(liquid.points[e.second]);
  int uses = 0;
  tree.overlapping(box, [&](std::uint32_t i) {
    const glm::uvec3& v = liquid.triangles[surface[i]].points;
    for (int k = 0; k < 3; ++k) uses += edge(v[k], v[(k + 1) % 3]) == e;
  });
  return uses == 1;
}

}  // namespace

std::vector<Contour> find_contours(const Topology& liquid, const std::vector<std::uint32_t>& surface,
                                   const Tree& surface_tree, const std::vector<Body>& bodies, std::size_t s,
                                   Warnings& warnings) {
  const Topology& solid = bodies[s].mesh;
  Box level;
  for (const std::uint32_t f : surface) level.add(liquid.box(f));
  std::vector<std::uint32_t> near;
  for (std::size_t t = 0; t < solid.triangles.size(); ++t) {
    if (solid.box(t).overlaps(level)) near.push_back(static_cast<std::uint32_t>(t));
  }
  if (near.empty()) return {};
  Search search(liquid, solid, choose_shift(bodies, s, level, warnings));
  for (const std::uint32_t t : near) {
    std::vector<std::uint32_t> hits;
    surface_tree.overlapping(solid.box(t), [&](std::uint32_t i) { hits.push_back(surface[i]); });
    std::sort(hits.begin(), hits.end());
    for (const std::uint32_t f : hits) search.pair(f, t);
  }

  const std::vector<Segment>& segments = search.segments();
  const std::vector<ContourPoint>& points = search.points();
  std::multimap<std::uint32_t, std::uint32_t> starting;  // point -> segment
  std::vector<int> arriving(points.size(), 0);
  for (std::uint32_t i = 0; i < segments.size(); ++i) {
    starting.emplace(segments[i].from, i);
    ++arriving[segments[i].to];
  }
  std::vector<bool> used(segments.size(), false);
  std::vector<Contour> result;
  std::size_t open = 0, thin = 0;
  const auto follow = [&](std::uint32_t first) {
    Contour contour{false, {}};
    std::optional<glm::dvec3> before;
    std::uint32_t at = segments[first].from;
    for (std::optional<std::uint32_t> next = first; next;) {
      used[*next] = true;
      ContourPoint p = points[at];
      p.after = segments[*next].normal_from;
      p.before = before.value_or(p.after);
      contour.points.push_back(p);
      before = segments[*next].normal_to;
      at = segments[*next].to;
      next.reset();
      if (at == segments[first].from) break;
      const auto [low, high] = starting.equal_range(at);
      for (auto i = low; i != high && !next; ++i) {
        if (!used[i->second]) next = i->second;
      }
    }
    if (at == segments[first].from) {
      contour.closed = true;
      contour.points.front().before = *before;
    } else {
      ContourPoint p = points[at];
      p.before = p.after = *before;
      contour.points.push_back(p);
    }
    for (ContourPoint& p : contour.points) {
      if (p.border && !is_border(liquid, surface, surface_tree, *p.border)) p.border.reset();
    }
    const bool whole = contour.closed || (contour.points.front().border && contour.points.back().border);
    if (!whole) {
      ++open;
    } else if (contour.closed && !encloses(contour)) {
      ++thin;
    } else {
      result.push_back(std::move(contour));
    }
  };
  for (std::uint32_t i = 0; i < segments.size(); ++i) {
    if (!used[i] && arriving[segments[i].from] == 0) follow(i);
  }
  for (std::uint32_t i = 0; i < segments.size(); ++i) {
    if (!used[i]) follow(i);
  }
  if (open > 0) {
    warnings.push_back({"solid '" + bodies[s].name + "' is open where it meets the liquid: " + std::to_string(open) +
                            (open == 1 ? " contour that ends within the liquid encloses nothing and gets no meniscus"
                                       : " contours that end within the liquid enclose nothing and get no meniscus") +
                            "; close the solid or give it thickness",
                        {s}});
  }
  if (thin > 0) {
    warnings.push_back({"solid '" + bodies[s].name +
                            "' has no thickness where it meets the liquid, or only touches it: " +
                            std::to_string(thin) + (thin == 1 ? " contour encloses" : " contours enclose") +
                            " nothing and " + (thin == 1 ? "gets" : "get") + " no meniscus; give it thickness there",
                        {s}});
  }
  return result;
}

}  // namespace meniscus

#include "tests/support/meniscus/soundness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <map>
#include <random>

#include "meniscus/predicates.h"

namespace soundness {
namespace {

using glm::dvec2;
using glm::dvec3;
using meniscus::Box;
using meniscus::orient2d;
using meniscus::orient3d;
using Corners = std::array<dvec3, 3>;
using Key = std::array<double, 3>;

Key key(const dvec3& p) { return {p.x, p.y, p.z}; }

Corners corners(const TriangleMesh& mesh, const glm::uvec3& t) {
  return {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
}

Box box_of(const Corners& c) {
  Box box;
  for (const dvec3& p : c) box.add(p);
  return box;
}

// Does the open segment pq pass through the inside or the border of the triangle, not in its plane?
bool pierces(const dvec3& p, const dvec3& q, const Corners& c) {
  const int sp = orient3d(c[0], c[1], c[2], p), sq = orient3d(c[0], c[1], c[2], q);
  if (sp == sq || sp == 0 || sq == 0) return false;
  int side[3];
  for (int i = 0; i < 3; ++i) side[i] = orient3d(p, q, c[i], c[(i + 1) % 3]);
  const bool low = side[0] < 0 || side[1] < 0 || side[2]<0, high = side[0]> 0 || side[1] > 0 || side[2] > 0;
  return !(low && high);
}

// Two triangles of one plane, seen along the axis on which their normal is longest.
bool overlap_in_plane(const Corners& a, const Corners& b) {
  const dvec3 n = glm::abs(glm::cross(a[1] - a[0], a[2] - a[0]));
  const int axis = n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2;
  const auto flat = [&](const dvec3& p) { return dvec2(p[(axis + 1) % 3], p[(axis + 2) % 3]); };
  const auto separated = [&](const Corners& s, const Corners& t) {  // by an edge of s
    for (int i = 0; i < 3; ++i) {
      const dvec2 p = flat(s[i]), q = flat(s[(i + 1) % 3]);
      const int own = orient2d(p, q, flat(s[(i + 2) % 3]));
      bool apart = true;
      for (const dvec3& x : t) apart = apart && orient2d(p, q, flat(x)) * own <= 0;
      if (apart) return true;
    }
    return false;
  };
  return !separated(a, b) && !separated(b, a);
}

bool intersect(const Corners& a, const Corners& b) {
  int shared = 0;
  for (const dvec3& p : a) shared += std::find(b.begin(), b.end(), p) != b.end();
  if (shared == 3) return true;
  int above[3];
  for (int i = 0; i < 3; ++i) above[i] = orient3d(a[0], a[1], a[2], b[i]);
  if (above[0] == 0 && above[1] == 0 && above[2] == 0) return overlap_in_plane(a, b);
  if (shared == 2) return false;
  for (int i = 0; i < 3; ++i) {
    if (pierces(a[i], a[(i + 1) % 3], b) || pierces(b[i], b[(i + 1) % 3], a)) return true;
  }
  return false;
}

double least_angle(const Corners& c) {
  double least = glm::pi<double>();
  for (int i = 0; i < 3; ++i) {
    const dvec3 a = c[(i + 1) % 3] - c[i], b = c[(i + 2) % 3] - c[i];
    least = std::min(least, std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
  }
  return glm::degrees(least);
}

double distance_to(const Corners& c, const dvec3& x) {
  const dvec3 n = glm::cross(c[1] - c[0], c[2] - c[0]);
  double least = 1e300;
  bool over = glm::dot(n, n) > 0;
  for (int i = 0; i < 3; ++i) {
    const dvec3 e = c[(i + 1) % 3] - c[i];
    over = over && glm::dot(glm::cross(e, x - c[i]), n) >= 0;
    const double square = glm::dot(e, e), s = square > 0 ? glm::clamp(glm::dot(x - c[i], e) / square, 0.0, 1.0) : 0;
    least = std::min(least, glm::distance(x, c[i] + s * e));
  }
  return over ? std::abs(glm::dot(x - c[0], n)) / glm::length(n) : least;
}

// Edges of one triangle, from first to second, corners merged by position.
std::vector<std::pair<std::size_t, std::size_t>> border(const TriangleMesh& mesh) {
  std::map<Key, std::size_t> first;
  std::vector<std::size_t> point;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    point.push_back(first.emplace(key(mesh.positions[i]), i).first->second);
  }
  std::map<std::pair<std::size_t, std::size_t>, int> uses;
  for (const glm::uvec3& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) ++uses[std::minmax(point[t[i]], point[t[(i + 1) % 3]])];
  }
  std::vector<std::pair<std::size_t, std::size_t>> result;
  for (const glm::uvec3& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const std::size_t a = point[t[i]], b = point[t[(i + 1) % 3]];
      if (uses[std::minmax(a, b)] == 1) result.emplace_back(a, b);
    }
  }
  return result;
}

dvec3 flat(const dvec3& p) { return {p.x, 0, p.z}; }

}  // namespace

std::size_t self_intersections(const TriangleMesh& mesh) {
  std::vector<Box> boxes;
  for (const glm::uvec3& t : mesh.triangles) boxes.push_back(box_of(corners(mesh, t)));
  const meniscus::Tree tree(boxes);
  std::size_t count = 0;
  for (std::uint32_t t = 0; t < boxes.size(); ++t) {
    tree.overlapping(boxes[t], [&](std::uint32_t u) {
      if (t < u) count += intersect(corners(mesh, mesh.triangles[t]), corners(mesh, mesh.triangles[u]));
    });
  }
  return count;
}

double smallest_new_angle(const TriangleMesh& result, const TriangleMesh& liquid) {
  const auto sorted = [](const Corners& c) {
    std::array<Key, 3> k{key(c[0]), key(c[1]), key(c[2])};
    std::sort(k.begin(), k.end());
    return k;
  };
  std::set<std::array<Key, 3>> own;
  for (const glm::uvec3& t : liquid.triangles) own.insert(sorted(corners(liquid, t)));
  double least = 180;
  for (const glm::uvec3& t : result.triangles) {
    const double angle = least_angle(corners(result, t));
    if (angle < least && !own.contains(sorted(corners(result, t)))) least = angle;
  }
  return least;
}

std::set<std::size_t> contact_vertices(const TriangleMesh& result, const TriangleMesh& liquid) {
  std::vector<Corners> own;
  std::vector<Box> boxes;
  double size = 0;
  for (const auto& [a, b] : border(liquid)) {
    own.push_back({flat(liquid.positions[a]), flat(liquid.positions[b]), flat(liquid.positions[b])});
    boxes.push_back(box_of(own.back()));
    size = std::max(size, glm::length(liquid.positions[a]));
  }
  const meniscus::Tree tree(std::move(boxes));
  std::set<std::size_t> contacts;
  for (const auto& [a, b] : border(result)) {
    const dvec3 ends[2] = {flat(result.positions[a]), flat(result.positions[b])};
    double off[2] = {1e300, 1e300};
    for (int k = 0; k < 2; ++k) {
      tree.nearest(ends[k], 1e300,
                   [&](std::uint32_t i) { return off[k] = std::min(off[k], distance_to(own[i], ends[k])); });
    }
    if (std::max(off[0], off[1]) > 1e-9 * size) contacts.insert({a, b});
  }
  return contacts;
}

Shell::Shell(const TriangleMesh& mesh) : mesh_(mesh), plan_({}), tree_({}) {
  std::vector<Box> flat_boxes, boxes;
  double volume = 0;
  for (const dvec3& p : mesh.positions) box_.add(p);
  const dvec3 middle = 0.5 * (box_.low + box_.high);
  for (const glm::uvec3& t : mesh.triangles) {
    const Corners c = corners(mesh, t);
    flat_boxes.push_back(box_of({flat(c[0]), flat(c[1]), flat(c[2])}));
    boxes.push_back(box_of(c));
    volume += glm::dot(c[0] - middle, glm::cross(c[1] - middle, c[2] - middle));
  }
  plan_ = meniscus::Tree(std::move(flat_boxes));
  tree_ = meniscus::Tree(std::move(boxes));
  outward_ = volume < 0 ? -1 : 1;
}

std::vector<Shell::Hit> Shell::column(double x, double z) const {
  std::vector<Hit> hits;
  Box line;
  line.add({x, 0, z});
  plan_.overlapping(line, [&](std::uint32_t t) {
    const Corners c = corners(mesh_, mesh_.triangles[t]);
    const dvec2 p(z, x);
    double w[3], total = 0;
    int sign[3];
    for (int i = 0; i < 3; ++i) {
      const dvec2 a = meniscus::planar(c[(i + 1) % 3]), b = meniscus::planar(c[(i + 2) % 3]);
      w[i] = meniscus::cross(a - p, b - p);
      sign[i] = orient2d(a, b, p);
      total += w[i];
    }
    if (total == 0 || sign[0] * sign[1] < 0 || sign[1] * sign[2] < 0 || sign[2] * sign[0] < 0) return;
    hits.push_back({(w[0] * c[0].y + w[1] * c[1].y + w[2] * c[2].y) / total, total > 0});
  });
  return hits;
}

int Shell::winding(const dvec3& p) const {
  Box point;
  point.add(p);
  if (!box_.overlaps(point)) return 0;
  int sum = 0;
  for (const Hit& hit : column(p.x, p.z)) {
    if (hit.height > p.y) sum += hit.up ? 1 : -1;
  }
  return outward_ * sum;
}

double Shell::distance(const dvec3& p) const {
  double least = 1e300;
  tree_.nearest(p, least, [&](std::uint32_t t) {
    return least = std::min(least, distance_to(corners(mesh_, mesh_.triangles[t]), p));
  });
  return least;
}

Coverage cover(const TriangleMesh& flat_result, const TriangleMesh& liquid, const std::vector<Shell>& solids,
               double tolerance) {
  const Shell level(liquid), result(flat_result);
  std::vector<Box> areas{level.box()};  // the whole, and each solid, where it may meet the liquid
  for (const Shell& s : solids) {
    Box near{glm::max(s.box().low, level.box().low), glm::min(s.box().high, level.box().high)};
    if (near.low.x < near.high.x && near.low.z < near.high.z) areas.push_back(near.grown(2 * tolerance));
  }
  std::mt19937_64 random(3);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  Coverage coverage;
  const int cells = areas.size() > 30 ? 8 : 40;
  for (const Box& area : areas) {
    for (int k = 0; k < cells * cells; ++k) {
      const dvec3 size = area.high - area.low;
      const double x = area.low.x + size.x * (k % cells + uniform()) / cells;
      const double z = area.low.z + size.z * (k / cells + uniform()) / cells;
      std::vector<double> heights;
      for (const Shell::Hit& hit : level.column(x, z)) {
        if (hit.up) heights.push_back(hit.height);
      }
      if (heights.size() != 1) continue;
      const dvec3 p(x, heights[0], z);
      bool inside = false, doubtful = false;
      for (const Shell& s : solids) {
        Box point;
        point.add(p);
        if (!s.box().grown(tolerance).overlaps(point)) continue;
        inside = inside || s.winding(p) != 0;
        doubtful = doubtful || s.distance(p) < tolerance;
      }
      if (doubtful) continue;
      std::size_t covered = 0;
      for (const Shell::Hit& hit : result.column(x, z)) covered += hit.up;
      ++coverage.asked;
      coverage.inside += inside;
      if (covered != (inside ? 0u : 1u)) ++coverage.wrong, coverage.example = p;
    }
  }
  return coverage;
}

double deepest_within(const Surface& surface, const std::vector<Shell>& solids) {
  double deepest = 0;
  for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
    if (!surface.meniscus[t]) continue;
    const Corners c = corners(surface.mesh, surface.mesh.triangles[t]);
    const dvec3 middle = (c[0] + c[1] + c[2]) / 3.0;
    constexpr double kSag = 0.06;  // of a chord, over an arc of 27 degrees
    const double longest = std::max({glm::distance(c[0], c[1]), glm::distance(c[1], c[2]), glm::distance(c[2], c[0])});
    for (const Shell& s : solids) {
      if (s.winding(middle) != 0) deepest = std::max(deepest, s.distance(middle) - kSag * longest);
    }
  }
  return deepest;
}

}  // namespace soundness

#include "meniscus/columns.h"

#include <algorithm>
#include <cmath>

#include "meniscus/predicates.h"

namespace meniscus {
namespace {

constexpr double kCorner = 0.06;  // of the polyline or of the normals, radians

double angle(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}
double angle(const glm::dvec2& a, const glm::dvec2& b) { return std::atan2(std::abs(cross(a, b)), glm::dot(a, b)); }

bool is_joint(const ContourPoint& p) { return angle(p.before, p.after) > kCorner; }

glm::dvec3 blend(const glm::dvec3& a, const glm::dvec3& b, double t) {
  const glm::dvec3 sum = a + t * (b - a);
  const double length = glm::length(sum);
  return length > 0 ? sum / length : a;
}

ContourPoint between(const ContourPoint& p, const ContourPoint& q, double t) {
  const glm::dvec3 normal = blend(p.after, q.before, t);
  return {p.position + t * (q.position - p.position), blend(p.liquid_normal, q.liquid_normal, t), normal, normal, {}};
}

// Leaves out points within `tolerance` of the one before; the last of a closed contour against the first as well.
std::vector<ContourPoint> merge(const Contour& contour, double tolerance) {
  constexpr double kSmooth = 1e-6;
  std::vector<ContourPoint> kept;
  const auto absorb = [](ContourPoint& into, const ContourPoint& p) {  // p follows `into`
    const bool take = !into.border && (p.border || (is_joint(p) && !is_joint(into)));
    const bool smooth = angle(into.before, into.after) < kSmooth && angle(p.before, p.after) < kSmooth;
    if (!take && smooth && angle(into.after, p.after) < kCorner) return;  // its normals are those of its own place
    if (take) into.position = p.position, into.liquid_normal = p.liquid_normal, into.border = p.border;
    into.after = p.after;
  };
  for (const ContourPoint& p : contour.points) {
    const bool close = !kept.empty() && glm::distance(kept.back().position, p.position) < tolerance;
    if (close && !(p.border && kept.back().border)) {
      absorb(kept.back(), p);
    } else {
      kept.push_back(p);
    }
  }
  if (contour.closed && kept.size() > 3 && glm::distance(kept.back().position, kept.front().position) < tolerance) {
    absorb(kept.back(), kept.front());
    kept.front() = kept.back();
    kept.pop_back();
  }
  return kept;
}

// Leaves out points in the middle of flat facets, where neither the way nor a normal turns: so that the averages at the
// facets' edges are spread over whole facets.
std::vector<ContourPoint> straighten(const std::vector<ContourPoint>& points, bool closed) {
  constexpr double kTurn = 1e-6;
  std::vector<ContourPoint> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ContourPoint& p = points[i];
    if (kept.empty() || (!closed && i + 1 == points.size())) {
      kept.push_back(p);
      continue;
    }
    const ContourPoint &last = kept.back(), &next = points[(i + 1) % points.size()];
    const bool flat = angle(p.position - last.position, next.position - p.position) < kTurn &&
                      angle(last.after, p.before) < kTurn && angle(p.before, p.after) < kTurn &&
                      angle(p.after, next.before) < kTurn;
    if (!flat) kept.push_back(p);
  }
  return kept;
}

glm::dvec2 along(const ContourPoint& a, const ContourPoint& b) { return planar(b.position) - planar(a.position); }

// N_s projected onto the liquid; `left` of the contour where the solid's normal says nothing (or nonsense).
glm::dvec2 contour_normal(const glm::dvec3& solid_normal, const glm::dvec3& liquid_normal, const glm::dvec2& left) {
  const glm::dvec2 n = planar(solid_normal - glm::dot(solid_normal, liquid_normal) * liquid_normal);
  const double length = glm::length(n);
  constexpr double kSense = 0.3;
  return length > 1e-6 && glm::dot(n, left) > kSense * length ? n / length : left;
}

glm::dvec2 left_of(const glm::dvec2& way) {
  const double length = glm::length(way);
  return length > 0 ? glm::dvec2(-way.y, way.x) / length : glm::dvec2(1, 0);
}

// Points at most `step` apart, the new ones on the segments between the others.
std::vector<ContourPoint> divide(const std::vector<ContourPoint>& points, bool closed, double step) {
  std::vector<ContourPoint> result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ContourPoint &p = points[i], &q = points[(i + 1) % points.size()];
    result.push_back(p);
    if (!closed && i + 1 == points.size()) break;
    const double parts = std::ceil(glm::distance(p.position, q.position) / step);
    for (double k = 1; k < parts; ++k) result.push_back(between(p, q, k / parts));
  }
  return result;
}

// The wanted distance between nodes, interpolated; calls come in ascending order.
class Sizes {
 public:
  Sizes(const std::vector<Size>& sizes, double otherwise) : sizes_(sizes), otherwise_(otherwise) {}
  double at(double along) {
    if (sizes_.empty()) return otherwise_;
    while (k_ + 1 < sizes_.size() && sizes_[k_ + 1].along < along) ++k_;
    if (k_ + 1 == sizes_.size()) return sizes_[k_].size;
    const Size &a = sizes_[k_], &b = sizes_[k_ + 1];
    return a.size + std::max(along - a.along, 0.0) / (b.along - a.along) * (b.size - a.size);
  }

 private:
  const std::vector<Size>& sizes_;
  const double otherwise_;
  std::size_t k_ = 0;
};

}  // namespace

ContactLine refine(const Contour& contour, std::size_t solid, double sweep_length, const Resolution& resolution) {
  double perimeter = 0;
  for (std::size_t i = 0; i + 1 < contour.points.size() + contour.closed; ++i) {
    perimeter += glm::distance(contour.points[i].position, contour.points[(i + 1) % contour.points.size()].position);
  }
  std::vector<ContourPoint> points =
      straighten(merge(contour, std::min(1e-3 * sweep_length, perimeter / 512)), contour.closed);
  for (ContourPoint& p : points) {
    if (!is_joint(p)) p.before = p.after = blend(p.before, p.after, 0.5);
  }
  constexpr double kMostFine = 2e5;  // columns: a contour of kilometres is no reason to run out of memory
  const double fine = std::max(kFineColumn * resolution.fineness.coarseness() * sweep_length, perimeter / kMostFine);
  points = divide(points, contour.closed, fine);
  const std::size_t n = points.size(), segments = contour.closed ? n : n - 1;

  // Corners end the runs along which nodes are spread evenly.
  std::vector<bool> corner(n, false);
  for (std::size_t i = 0; i < n; ++i) {
    const bool end = !contour.closed && (i == 0 || i + 1 == n);
    corner[i] = end || is_joint(points[i]) ||
                angle(along(points[(i + n - 1) % n], points[i]), along(points[i], points[(i + 1) % n])) > kCorner;
  }
  const auto first_corner = std::find(corner.begin(), corner.end(), true) - corner.begin();
  const std::size_t start = static_cast<std::size_t>(first_corner) == n ? 0 : static_cast<std::size_t>(first_corner);
  corner[start] = true;

  constexpr double kShort = 0.13;  // columns
  Sizes sizes(resolution.sizes, fine);
  double along_line = 0;
  std::vector<ContourPoint> nodes;
  for (std::size_t done = 0; done < segments;) {
    const std::size_t a = (start + done) % n;
    std::vector<double> cost{0};  // accumulated along the run, in columns
    std::size_t count = 0;
    do {
      const ContourPoint& p = points[(a + count) % n];
      const ContourPoint& q = points[(a + count + 1) % n];
      const double length = glm::distance(p.position, q.position);
      const double turn = angle(p.after, q.before);
      const double most = turn > 0 ? resolution.fineness.turn_at(length / turn) : 1;
      cost.push_back(cost.back() + std::max(length / sizes.at(along_line + 0.5 * length), turn / most));
      along_line += length;
      ++count;
    } while (done + count < segments && !corner[(a + count) % n]);
    nodes.push_back(points[a]);
    const double columns = std::max(1.0, std::ceil(cost.back() - 0.05));
    std::size_t s = 0;
    for (double k = 1; k < columns; ++k) {
      const double at = cost.back() * k / columns;
      while (s + 1 < count && cost[s + 1] < at) ++s;
      const ContourPoint& p = points[(a + s) % n];
      const ContourPoint& q = points[(a + s + 1) % n];
      const double t = (at - cost[s]) / (cost[s + 1] - cost[s]);
      if (cost[s + 1] - cost[s] > kShort * cost.back() / columns) {
        nodes.push_back(between(p, q, t));
      } else {  // a finely divided solid's own points lie on it best
        nodes.push_back(t < 0.5 ? p : q);
      }
    }
    done += count;
  }
  if (!contour.closed) nodes.push_back(points.back());

  ContactLine line{solid, contour.closed, sweep_length, {}, resolution.fineness.profile, resolution.fineness};
  const std::size_t m = nodes.size();
  for (std::size_t i = 0; i < m; ++i) {
    const ContourPoint& p = nodes[i];
    const bool has_before = contour.closed || i > 0, has_after = contour.closed || i + 1 < m;
    const glm::dvec2 in = has_before ? along(nodes[(i + m - 1) % m], p) : along(p, nodes[i + 1]);
    const glm::dvec2 out = has_after ? along(p, nodes[(i + 1) % m]) : in;
    Node node{p.position, p.liquid_normal, {}, {}, {}, is_joint(p), 1e300, 1, p.border};
    const glm::dvec2 mean = left_of(glm::normalize(in) + glm::normalize(out));
    const auto side = [&](const glm::dvec3& normal, const glm::dvec2& left) {
      Side s{};
      s.solid_normal = normal;
      s.direction = contour_normal(normal, p.liquid_normal, left);
      return s;
    };
    node.before = side(p.before, node.joint ? left_of(in) : mean);
    node.after = side(p.after, node.joint ? left_of(out) : mean);
    node.contact = side(blend(p.before, p.after, 0.5), mean);
    line.nodes.push_back(node);
  }
  return line;
}

void differentiate(ContactLine& line) {
  const std::size_t n = line.nodes.size();
  struct Change {
    double length;
    glm::dvec2 direction;
    double rise;
    glm::dvec2 slide;
    double reach;
    glm::dvec2 toward;
  };
  std::vector<Change> change;
  for (std::size_t i = 0; i < line.segments(); ++i) {
    const Node& a = line.nodes[i];
    const Node& b = line.next(i);
    change.push_back({glm::distance(planar(a.position), planar(b.position)), b.before.direction - a.after.direction,
                      b.before.rise - a.after.rise, b.before.slide - a.after.slide, b.before.reach - a.after.reach,
                      b.before.toward - a.after.toward});
  }
  const auto set = [](Side& side, const Change& c) {
    if (c.length == 0) return;
    const glm::dvec2 forward{side.direction.y, -side.direction.x};
    side.curvature = glm::dot(c.direction, forward) / c.length;
    side.rise_slope = c.rise / c.length;
    side.slide_slope = c.slide / c.length;
    side.reach_slope = c.reach / c.length;
    side.toward_slope = c.toward / c.length;
  };
  for (std::size_t i = 0; i < n; ++i) {
    Node& node = line.nodes[i];
    const bool has_in = line.closed || i > 0, has_out = line.closed || i + 1 < n;
    const Change in = has_in ? change[(i + change.size() - 1) % change.size()] : change[i];
    const Change out = has_out ? change[i] : in;
    const Change both{in.length + out.length, in.direction + out.direction, in.rise + out.rise,
                      in.slide + out.slide,   in.reach + out.reach,         in.toward + out.toward};
    set(node.before, node.joint ? in : both);
    set(node.after, node.joint ? out : both);
    set(node.contact, both);
  }
}

}  // namespace meniscus

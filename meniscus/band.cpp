#include "meniscus/band.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>

#include "meniscus/crease.h"
#include "meniscus/predicates.h"
#include "meniscus/profile.h"

namespace meniscus {
namespace {

constexpr double kFirst = 1.0 / 180;                   // spacing of layers at the wall, in sweep lengths
constexpr double kGrowth = 0.08, kGrowthBeyond = 0.3;  // of the spacing, per distance

// A point on a column. In a fan halves come before quarters: what is thinned out stays even.
struct Candidate {
  double distance;
  std::uint32_t line, rank, column;
};

// Where a column starts and in which direction it goes.
struct Column {
  std::uint32_t rank;
  glm::dvec2 origin;
  Foot foot;
  double end = std::numeric_limits<double>::infinity();  // distance at which it meets a crease, and the sine of
  double sine = 1;                                       // the angle between the two
};

glm::dvec2 rotated(const glm::dvec2& d, double a) {
  return {std::cos(a) * d.x - std::sin(a) * d.y, std::sin(a) * d.x + std::cos(a) * d.y};
}

// Columns for `turn` from one side to another: how many steps, an even number.
int steps_for(double turn, const Fineness& fineness) {
  return 2 * static_cast<int>(std::ceil(-turn / (2 * fineness.turn_at(0))));
}

// In a fan, halves come before quarters.
std::uint32_t rank_of(int step, int steps) {
  std::uint32_t rank = step == 0 || step == steps ? 0 : 32;
  for (int k = step; rank > 1 && k % 2 == 0; k /= 2) --rank;
  return rank;
}

// The columns of one node: one, or at a convex joint a fan.
void add_columns(std::vector<Column>& columns, const ContactLine& line, std::size_t l, std::size_t i) {
  const Node& node = line.nodes[i];
  const glm::dvec2 origin = planar(node.position);
  Foot foot;
  foot.line = l, foot.node = i;
  const double turn = turn_between(node.before.direction, node.after.direction);
  if (!node.joint || turn >= 0) {
    foot.from = foot.to = &node.contact, foot.direction = node.contact.direction;
    columns.push_back({0, origin, foot});
    return;
  }
  foot.from = &node.before, foot.to = &node.after, foot.fan = -turn;
  const int n = steps_for(turn, line.fineness);
  for (int k = 0; k <= n; ++k) {
    foot.t = static_cast<double>(k) / n;
    foot.direction = k == n ? node.after.direction : rotated(node.before.direction, turn * k / n);
    columns.push_back({rank_of(k, n), origin, foot});
  }
}

// Columns between node i and the next, where the contour turns much though the solid's normals, nearly upright, do not.
void add_columns_between(std::vector<Column>& columns, const ContactLine& line, std::size_t l, std::size_t i) {
  constexpr double kMuch = -3;  // usual turns
  const Node &node = line.nodes[i], &next = line.next(i);
  const double turn = turn_between(node.after.direction, next.before.direction);
  if (!(turn < kMuch * line.fineness.turn_at(0))) return;
  Foot foot;
  foot.line = l, foot.node = i, foot.from = &node.after, foot.to = &next.before;
  const int n = steps_for(turn, line.fineness);
  for (int k = 1; k < n; ++k) {  // evenly spread, at the place where the interpolated normal has that direction
    foot.direction = rotated(node.after.direction, turn * k / n);
    const double from = cross(node.after.direction, foot.direction), to = cross(next.before.direction, foot.direction);
    foot.t = from / (from - to);
    const glm::dvec2 origin = planar(node.position) + foot.t * (planar(next.position) - planar(node.position));
    columns.push_back({rank_of(k, n), origin, foot});
  }
}

}  // namespace

Grading::Grading(const ContactLine& line, double sweep_length)
    : sweep_(line.sweep), unit_(sweep_length), fineness_(line.fineness) {
  double length = 0, longest = 0, shortest = sweep_length;
  for (std::size_t i = 0; i < line.segments(); ++i) {
    const double column = glm::distance(line.nodes[i].position, line.next(i).position);
    length += column, longest = std::max(longest, column), shortest = std::min(shortest, column);
  }
  const double column = length / static_cast<double>(line.segments());
  most_ = fineness_.layer * unit_;
  // Round thin solids normals turn with the distance, too: layers widen no faster than columns do.
  growth_ = std::max(kGrowth, std::min(kGrowth * fineness_.coarseness(), fineness_.turn_at(0)));
  first_ = column;
  if (sweep_ > 0) {  // no triangle at the wall much longer than wide, along it or across
    const double finest = std::min(kFirst * fineness_.coarseness(), fineness_.spacing(0));
    const double least = std::max(finest * unit_, longest / kAspect);
    first_ = std::min({column, least, kAspect * shortest, most_});
  }
  if (line.profile == Profile::solved && sweep_ > 0) {
    first_ = fineness_.spacing(0) * line.sweep, growth_ = fineness_.growth, most_ = fineness_.layer * line.sweep;
  }
}

double Grading::spacing(double distance) const {
  if (sweep_ == 0) return first_ + kGrowthBeyond * distance;
  if (distance <= sweep_) {
    if (fineness_.profile == Profile::solved) return fineness_.spacing(distance / sweep_) * sweep_;
    const double bent = fineness_.spacing(distance / sweep_) * unit_;
    return std::min(std::max(bent, first_), first_ + growth_ * distance);
  }
  return most_ + kGrowthBeyond * (distance - sweep_);
}

std::vector<double> Grading::layers(double extent) const {
  std::vector<double> result;
  for (double d = 0; sweep_ > 0 && d < sweep_;) result.push_back(d += spacing(d));
  if (!result.empty()) {
    const double fit = sweep_ / result.back();
    for (double& d : result) d *= fit;
    result.back() = sweep_;
  }
  for (double d = sweep_; d < extent;) result.push_back(d += spacing(d));
  return result;
}

std::size_t Spacing::bucket(double i, double j) const {
  const auto x = static_cast<std::uint64_t>(static_cast<std::int64_t>(i)),
             y = static_cast<std::uint64_t>(static_cast<std::int64_t>(j));
  const std::uint64_t mixed = (x * 0x9e3779b97f4a7c15u ^ y) * 0xd6e8feb86659fd93u;
  return static_cast<std::size_t>(mixed ^ mixed >> 32) & (first_.size() - 1);
}

void Spacing::enter(std::uint32_t point) {
  std::uint32_t& first = first_[bucket(std::floor(points_[point].x / size_), std::floor(points_[point].y / size_))];
  next_[point] = first;
  first = point;
}

void Spacing::rebuild(double size) {
  size_ = size;
  first_.assign(std::bit_ceil(2 * points_.size() + 64), kNone);
  for (std::uint32_t i = 0; i < points_.size(); ++i) enter(i);
}

void Spacing::take(const glm::dvec2& p) {
  points_.push_back(p);
  next_.push_back(kNone);
  if (size_ == 0) return;
  if (points_.size() > first_.size()) {
    rebuild(size_);
  } else {
    enter(static_cast<std::uint32_t>(points_.size() - 1));
  }
}

bool Spacing::claim(const glm::dvec2& p, double radius) {
  if (radius > size_) rebuild(2 * radius);
  const double x = std::floor(p.x / size_), y = std::floor(p.y / size_);
  // Only the cells within reach; one that shares a bucket with another adds points that are too far away.
  const double left = std::floor((p.x - radius) / size_), right = std::floor((p.x + radius) / size_);
  const double low = std::floor((p.y - radius) / size_), high = std::floor((p.y + radius) / size_);
  for (double i = std::min(left, x); i <= right; ++i) {
    for (double j = std::min(low, y); j <= high; ++j) {
      for (std::uint32_t q = first_[bucket(i, j)]; q != kNone; q = next_[q]) {
        if (glm::distance(p, points_[q]) < radius) return false;
      }
    }
  }
  take(p);
  return true;
}

std::vector<BandPoint> sweep(const std::vector<ContactLine>& lines, const std::vector<Grading>& gradings,
                             const Field& field, const Patch& patch, Spacing& spacing) {
  const double extent = glm::length(patch.box().high - patch.box().low);
  std::vector<Column> columns;
  std::vector<Candidate> candidates;
  std::vector<BandPoint> creases;
  for (std::size_t l = 0; l < lines.size(); ++l) {
    const std::vector<double> layers = gradings[l].layers(extent);
    const std::size_t first = columns.size();
    for (std::size_t i = 0; i < lines[l].nodes.size(); ++i) {
      add_columns(columns, lines[l], l, i);
      if (i < lines[l].segments()) add_columns_between(columns, lines[l], l, i);
    }
    CreaseRow row(field, lines, gradings[l], creases);
    for (std::size_t c = first; c < columns.size(); ++c) {
      Column& column = columns[c];
      double own = 0;  // how far it is surely the nearest
      for (const double d : layers) {
        const glm::dvec2 x = column.origin + d * column.foot.direction;
        if (patch.box().distance(glm::dvec3(x, 0)) > 0) break;
        constexpr double kNearer = 1 - 1e-6;
        if (field.any_foot(x, kNearer * d).exists()) {  // the column ends: another foot is nearer
          if (own > kCreaseReach * lines[l].sweep) break;
          const BandPoint end = end_on_crease(field, lines, column.origin, column.foot, d);
          column.end = end.foot.distance, column.sine = sine_to_crease(end);
          row.add(c - first, end);
          break;
        }
        own = d;
        candidates.push_back({d, static_cast<std::uint32_t>(l), column.rank, static_cast<std::uint32_t>(c)});
      }
    }
    if (lines[l].closed) row.close(columns.size() - first);
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.distance, a.line, a.rank, a.column) < std::tie(b.distance, b.line, b.rank, b.column);
  });
  // Line by line: whoever inserts them one after the other finds each near the one before.
  std::vector<std::vector<BandPoint>> of_line(lines.size());
  const auto claim = [&](const BandPoint& p, double radius) {
    if (!patch.covers(p.x) || patch.border_within(p.x, 0.5 * gradings[p.foot.line].spacing(p.foot.distance))) return;
    if (spacing.claim(p.x, radius)) of_line[p.foot.line].push_back(p);
  };
  constexpr double kApart = 0.5, kApartBeyond = 0.7;  // of the spacing
  std::stable_sort(creases.begin(), creases.end(),
                   [](const BandPoint& a, const BandPoint& b) { return a.foot.distance < b.foot.distance; });
  for (const BandPoint& p : creases) claim(p, kApart * gradings[p.foot.line].spacing(p.foot.distance));
  for (const Candidate& c : candidates) {
    const Column& column = columns[c.column];
    const double size = gradings[c.line].spacing(c.distance);
    if (column.sine * (column.end - c.distance) < kApart * size) continue;  // too near to the crease
    Foot foot = column.foot;
    foot.distance = c.distance;
    const bool beyond = c.distance > lines[c.line].sweep;
    claim({column.origin + c.distance * foot.direction, foot, {}}, (beyond ? kApartBeyond : kApart) * size);
  }
  std::vector<BandPoint> result;
  for (const std::vector<BandPoint>& points : of_line) result.insert(result.end(), points.begin(), points.end());
  return result;
}

}  // namespace meniscus

#include "meniscus/band.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "meniscus/predicates.h"

namespace meniscus {
namespace {

constexpr double kFirst = 1.0 / 180, kMost = 1.0 / 66;  // spacing of layers in sweep lengths: at the wall, in the band
constexpr double kGrowth = 0.08, kGrowthBeyond = 0.3;   // of the spacing, per distance

struct Candidate {
  double distance;
  std::size_t line;
  int rank;  // in a fan, halves come before quarters: what is thinned out stays even
  std::size_t node;
  glm::dvec2 x;
  Foot foot;
};

// Where a column starts and in which direction it goes.
struct Column {
  int rank;
  glm::dvec2 origin;
  Foot foot;
};

glm::dvec2 rotated(const glm::dvec2& d, double a) {
  return {std::cos(a) * d.x - std::sin(a) * d.y, std::sin(a) * d.x + std::cos(a) * d.y};
}

// Columns for `turn` from one side to another: how many steps, an even number.
int steps_for(double turn) { return 2 * static_cast<int>(std::ceil(-turn / (2 * kColumnTurn))); }

// In a fan, halves come before quarters.
int rank_of(int step, int steps) {
  int rank = step == 0 || step == steps ? 0 : 32;
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
  const int n = steps_for(turn);
  for (int k = 0; k <= n; ++k) {
    foot.t = static_cast<double>(k) / n;
    foot.direction = k == n ? node.after.direction : rotated(node.before.direction, turn * k / n);
    columns.push_back({rank_of(k, n), origin, foot});
  }
}

// Columns between node i and the next, where the contour turns much though the solid's normals, nearly upright, do not.
void add_columns_between(std::vector<Column>& columns, const ContactLine& line, std::size_t l, std::size_t i) {
  constexpr double kMuch = -3 * kColumnTurn;
  const Node &node = line.nodes[i], &next = line.next(i);
  const double turn = turn_between(node.after.direction, next.before.direction);
  if (!(turn < kMuch * line.coarseness)) return;
  Foot foot;
  foot.line = l, foot.node = i, foot.from = &node.after, foot.to = &next.before;
  const int n = steps_for(turn);
  for (int k = 1; k < n; ++k) {  // evenly spread, at the place where the interpolated normal has that direction
    foot.direction = rotated(node.after.direction, turn * k / n);
    const double from = cross(node.after.direction, foot.direction), to = cross(next.before.direction, foot.direction);
    foot.t = from / (from - to);
    const glm::dvec2 origin = planar(node.position) + foot.t * (planar(next.position) - planar(node.position));
    columns.push_back({rank_of(k, n), origin, foot});
  }
}

}  // namespace

Grading::Grading(const ContactLine& line, double sweep_length) : sweep_(line.sweep) {
  double length = 0, longest = 0, shortest = sweep_length;
  for (std::size_t i = 0; i < line.segments(); ++i) {
    const double column = glm::distance(line.nodes[i].position, line.next(i).position);
    length += column, longest = std::max(longest, column), shortest = std::min(shortest, column);
  }
  const double column = length / static_cast<double>(line.segments());
  most_ = line.coarseness * widest(sweep_length);
  first_ = column;
  if (sweep_ > 0) {  // no triangle at the wall much longer than wide, along it or across
    const double least = std::max(line.coarseness * kFirst * sweep_length, longest / kAspect);
    first_ = std::min({column, least, kAspect * shortest, most_});
  }
}

double Grading::widest(double sweep_length) { return kMost * sweep_length; }

double Grading::spacing(double distance) const {
  if (sweep_ == 0) return first_ + kGrowthBeyond * distance;
  if (distance <= sweep_) return std::min(most_, first_ + kGrowth * distance);
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

Spacing::Cell Spacing::cell(const glm::dvec2& p) const {
  return {static_cast<std::int64_t>(std::floor(p.x / size_)), static_cast<std::int64_t>(std::floor(p.y / size_))};
}

void Spacing::coarsen(double radius) {
  size_ = 2 * radius;
  cells_.clear();
  for (const glm::dvec2& p : points_) cells_[cell(p)].push_back(p);
}

void Spacing::take(const glm::dvec2& p) {
  points_.push_back(p);
  if (size_ > 0) cells_[cell(p)].push_back(p);
}

bool Spacing::claim(const glm::dvec2& p, double radius) {
  if (radius > size_) coarsen(radius);
  const Cell at = cell(p);
  for (std::int64_t i = -1; i <= 1; ++i) {
    for (std::int64_t j = -1; j <= 1; ++j) {
      const auto found = cells_.find({at.first + i, at.second + j});
      if (found == cells_.end()) continue;
      for (const glm::dvec2& q : found->second) {
        if (glm::distance(p, q) < radius) return false;
      }
    }
  }
  take(p);
  return true;
}

std::vector<BandPoint> sweep(const std::vector<ContactLine>& lines, const std::vector<Grading>& gradings,
                             const Field& field, const Patch& patch, Spacing& spacing) {
  const double extent = glm::length(patch.box().high - patch.box().low);
  std::vector<Candidate> candidates;
  for (std::size_t l = 0; l < lines.size(); ++l) {
    const std::vector<double> layers = gradings[l].layers(extent);
    std::vector<Column> columns;
    for (std::size_t i = 0; i < lines[l].nodes.size(); ++i) {
      add_columns(columns, lines[l], l, i);
      if (i < lines[l].segments()) add_columns_between(columns, lines[l], l, i);
    }
    for (auto& [rank, origin, foot] : columns) {
      for (const double d : layers) {
        foot.distance = d;
        const glm::dvec2 x = origin + d * foot.direction;
        if (patch.box().distance(glm::dvec3(x, 0)) > 0) break;
        constexpr double kNearer = 1 - 1e-6;
        if (field.foot(x, kNearer * d).exists()) break;  // here the column ends: another foot is nearer from here on
        candidates.push_back({d, l, rank, foot.node, x, foot});
      }
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.distance, a.line, a.rank, a.node) < std::tie(b.distance, b.line, b.rank, b.node);
  });
  std::vector<BandPoint> result;
  for (const Candidate& c : candidates) {
    const double size = gradings[c.line].spacing(c.distance);
    const bool beyond = c.distance > lines[c.line].sweep;
    if (!patch.at(c.x) || patch.border_within(c.x, 0.5 * size)) continue;
    if (spacing.claim(c.x, (beyond ? 0.7 : 0.5) * size)) result.push_back({c.x, c.foot});
  }
  // Line by line: whoever inserts them one after the other finds each near the one before.
  std::stable_sort(result.begin(), result.end(),
                   [](const BandPoint& a, const BandPoint& b) { return a.foot.line < b.foot.line; });
  return result;
}

}  // namespace meniscus

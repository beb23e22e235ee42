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

// The directions in which one node sends its points.
std::vector<std::pair<int, Foot>> directions(const ContactLine& of, std::size_t line, std::size_t i) {
  const Node& node = of.nodes[i];
  Foot foot;
  foot.line = line, foot.node = i;
  const double turn = turn_between(node.before.direction, node.after.direction);
  if (!node.joint || turn >= 0) {
    foot.from = foot.to = &node.contact, foot.direction = node.contact.direction;
    return {{0, foot}};
  }
  std::vector<std::pair<int, Foot>> result;
  foot.from = &node.before, foot.to = &node.after, foot.fan = -turn;
  const int n = 2 * static_cast<int>(std::ceil(-turn / (2 * kColumnTurn)));
  for (int j = 0; j <= n; ++j) {
    const double a = turn * j / n;
    const glm::dvec2 d = node.before.direction;
    foot.t = static_cast<double>(j) / n;
    foot.direction = j == n ? node.after.direction
                            : glm::dvec2(std::cos(a) * d.x - std::sin(a) * d.y, std::sin(a) * d.x + std::cos(a) * d.y);
    int rank = j == 0 || j == n ? 0 : 32;
    for (int k = j; rank > 1 && k % 2 == 0; k /= 2) --rank;
    result.emplace_back(rank, foot);
  }
  return result;
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
    for (std::size_t i = 0; i < lines[l].nodes.size(); ++i) {
      const Node& node = lines[l].nodes[i];
      for (auto& [rank, foot] : directions(lines[l], l, i)) {
        for (const double d : layers) {
          foot.distance = d;
          const glm::dvec2 x = planar(node.position) + d * foot.direction;
          if (patch.box().distance(glm::dvec3(x, 0)) > 0) break;
          constexpr double kNearer = 1 - 1e-6;
          if (field.foot(x, kNearer * d).exists()) break;  // here the column ends: another foot is nearer from here on
          candidates.push_back({d, l, rank, i, x, foot});
        }
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
  return result;
}

}  // namespace meniscus

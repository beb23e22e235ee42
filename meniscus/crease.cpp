#include "meniscus/crease.h"

#include <algorithm>
#include <cmath>

#include "meniscus/predicates.h"

namespace meniscus {
namespace {

// The foot of x on the line as curved as its normals say: feet between nodes are on chords.
glm::dvec2 place(const std::vector<ContactLine>& lines, const glm::dvec2& x, const Foot& foot) {
  const glm::dvec2 on_chord = x - foot.distance * foot.direction;
  if (foot.from == foot.to || foot.fan > 0) return on_chord;
  const ContactLine& line = lines[foot.line];
  const double chord = glm::distance(planar(line.nodes[foot.node].position), planar(line.next(foot.node).position));
  const double sag = -0.5 * turn_between(foot.from->direction, foot.to->direction) * chord * foot.t * (1 - foot.t);
  return on_chord + sag * foot.direction;
}

// Of the circle through a and b whose centre lies in the given direction from a.
double radius_through(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& direction) {
  return glm::dot(b - a, b - a) / (2 * glm::dot(b - a, direction));
}

}  // namespace

BandPoint end_on_crease(const Field& field, const std::vector<ContactLine>& lines, const glm::dvec2& origin, Foot foot,
                        double beyond) {
  constexpr double kPast = 1.001;  // looks for the other foot where it surely is nearer, chords or not
  constexpr double kNearer = 1 - 1e-9, kSame = 1e-9;
  constexpr int kMost = 40;
  BandPoint end{{}, foot, {}};
  double radius = beyond / kPast;
  // A circle that touches the line at `origin` shrinks until no other part of a line lies within (Ma, Bae, Choi 2012).
  for (int k = 0; k < kMost; ++k) {
    const double past = kPast * radius, was = radius;
    const glm::dvec2 centre = origin + past * foot.direction;
    const Foot nearer = field.foot(centre, kNearer * past);
    if (!nearer.exists()) break;
    end.other = nearer;
    const glm::dvec2 touched = place(lines, centre, nearer);
    radius = std::min(past, radius_through(origin, touched, foot.direction));
    if (std::abs(radius - was) > kSame * radius) continue;
    // The foot was sought from a little beyond; where it is not a corner, the circle touches the way through it.
    const double apart = 1 - glm::dot(foot.direction, nearer.direction);
    const bool corner = nearer.fan > 0 || nearer.from == nearer.to;
    if (!corner && apart > kSame) radius = glm::dot(origin - touched, nearer.direction) / apart;
    break;
  }
  end.x = origin + radius * foot.direction;
  end.foot.distance = end.other.distance = radius;
  return end;
}

double sine_to_crease(const BandPoint& end) { return 0.5 * glm::distance(end.foot.direction, end.other.direction); }

void CreaseRow::add(std::size_t column, const BandPoint& end) {
  if (last_ && last_->column + 1 == column) fill(last_->point, end);
  keep(end);
  last_ = End{column, end};
  if (!first_) first_ = last_;
}

void CreaseRow::close(std::size_t columns) {
  if (first_ && first_->column == 0 && last_->column + 1 == columns) fill(last_->point, first_->point);
}

void CreaseRow::keep(const BandPoint& p) {
  // Of wires so near each other that one's foot lies behind the other's, no circle between them is left.
  const double distance = p.foot.distance;
  if (p.other.exists() && distance > 0 && distance < kCreaseReach * lines_[p.foot.line].sweep) points_.push_back(p);
}

void CreaseRow::fill(const BandPoint& a, const BandPoint& b) {
  if (!a.other.exists() || !b.other.exists()) return;
  // Next to the ends of columns that meet the crease squarely no other points stand; those of slanted columns stand
  // between the ends.
  const double sine = std::min(sine_to_crease(a), sine_to_crease(b)), square = sine * sine;
  const double slant = square > 0.5 ? 0.5 / std::sqrt(square * std::max(1 - square, 1e-6)) : 1;
  constexpr double kStep = 0.9;  // of the spacing
  // Ends behind another wire's foot lie at less than no distance (see keep).
  const double nearest = std::max(std::min(a.foot.distance, b.foot.distance), 0.0);
  const double step = kStep * slant * grading_.spacing(nearest);
  constexpr double kMost = 1e3;
  const int parts = static_cast<int>(std::ceil(std::min(glm::distance(a.x, b.x) / step, kMost)));
  for (int k = 1; k < parts; ++k) {
    const glm::dvec2 x = a.x + (static_cast<double>(k) / parts) * (b.x - a.x);
    const Foot foot = field_.foot(x);
    if (!foot.exists() || foot.distance == 0) continue;
    constexpr double kBeyond = 1.5;
    keep(end_on_crease(field_, lines_, place(lines_, x, foot), foot, kBeyond * foot.distance));
  }
}

}  // namespace meniscus

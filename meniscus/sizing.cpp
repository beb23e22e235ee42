#include "meniscus/sizing.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "meniscus/band.h"
#include "meniscus/field.h"
#include "meniscus/predicates.h"
#include "meniscus/profile.h"

namespace meniscus {
namespace {

constexpr double kGrowth = 0.2;  // of the distance between columns, per distance along the line
constexpr double kMostTriangles = 2e6, kMostSolved = 6e5;  // of all contours together
constexpr double kWithinPatch = 1.04;                      // sweep lengths: the patch reaches a little farther
constexpr double kUnset = 1e300;

// How far the column at this node reaches, up to `sweep`, before another foot is nearer; 0 where the liquid ends first.
double free_length(const Node& node, const Field& field, const Patch& patch, double sweep) {
  const glm::dvec2 from = planar(node.position);
  if (!patch.covers(from + kWithinPatch * sweep * node.contact.direction)) return 0;
  return field.free_length(from, node.contact.direction, sweep, 1);
}

// Leaves no size larger than that of a neighbour plus the growth over the distance between them.
void grade(std::vector<Size>& sizes, double length, bool closed) {
  const std::size_t n = sizes.size();
  const auto limit = [&](std::size_t from, std::size_t to) {
    double apart = std::abs(sizes[to].along - sizes[from].along);
    if (closed) apart = std::min(apart, length - apart);
    sizes[to].size = std::min(sizes[to].size, sizes[from].size + kGrowth * apart);
  };
  for (int round = 0; round < 1 + closed; ++round) {
    for (std::size_t i = closed ? 0 : 1; i < n; ++i) limit((i + n - 1) % n, i);
    for (std::size_t i = closed ? n : n - 1; i-- > 0;) limit((i + 1) % n, i);
  }
}

}  // namespace

std::vector<Resolution> find_resolutions(const std::vector<ContactLine>& lines, const std::vector<Body>& bodies,
                                         const Patch& patch, double sweep_length, double reach, Warnings& warnings) {
  const Field field(lines);
  const bool solved = !lines.empty() && lines.front().profile == Profile::solved;
  std::vector<Resolution> result;
  double triangles = 0, whole = 0;  // length, metres
  for (std::size_t l = 0; l < lines.size(); ++l) {
    const ContactLine& line = lines[l];
    const std::size_t n = line.nodes.size();
    const double fine = kFineColumn * line.fineness.coarseness() * sweep_length;
    const double unit = solved ? reach : sweep_length;  // of the fineness
    const double wide = kAspect * line.fineness.spacing(0) * unit;
    Resolution resolution{{}, line.fineness};
    std::vector<double> free;
    for (const Node& node : line.nodes) {
      free.push_back(node.joint ? 0 : free_length(node, field, patch, reach));
      resolution.sizes.push_back({0, free.back() > 0 ? wide : fine});
    }
    double length = 0;
    for (std::size_t i = 0; i < line.segments(); ++i) {
      const Node &a = line.nodes[i], &b = line.next(i);
      const double step = glm::distance(a.position, b.position);
      const double turn = std::abs(turn_between(a.after.direction, b.before.direction));
      Size &from = resolution.sizes[i], &to = resolution.sizes[(i + 1) % n];
      const double slant = std::abs(free[(i + 1) % n] - free[i]);
      double size = std::min(wide, std::max(fine, slant > 0 ? fine * step / slant : kUnset));
      if (turn > 0) size = std::min(size, line.fineness.turn_at(step / turn) * step / turn);
      from.size = std::min(from.size, size), to.size = std::min(to.size, size);
      length += step;
      if (i + 1 < n) to.along = length;
    }
    if (!line.closed) resolution.sizes.front().size = resolution.sizes.back().size = fine;
    grade(resolution.sizes, length, line.closed);
    for (std::size_t i = 0; i < line.segments(); ++i) {
      const double step = glm::distance(line.nodes[i].position, line.next(i).position);
      const double extent = free[i] > 0 ? free[i] : reach;
      constexpr double kAround = 1.4;  // triangles in and round the band, for each of the band's own
      triangles += kAround * 2 * step / resolution.sizes[i].size * line.fineness.layers(extent / unit);
    }
    whole += length;
    result.push_back(std::move(resolution));
  }
  const double most_triangles = solved ? kMostSolved : kMostTriangles;
  if (triangles <= most_triangles) return result;
  const double coarseness = std::sqrt(triangles / most_triangles);
  bool within = true;
  Error most;
  for (Resolution& resolution : result) {
    Fineness& fineness = resolution.fineness;
    fineness = fineness.coarser(coarseness);
    for (Size& s : resolution.sizes) s.size *= coarseness;
    within = within && fineness.within_tolerance();
    most = {std::max(most.height, fineness.error.height), std::max(most.normal, fineness.error.normal)};
  }
  if (within) return result;
  std::ostringstream message;
  message << "solid '" << bodies[lines.front().solid].name << "'";
  if (lines.size() > 1)
    message << " and others: their contours";
  else
    message << ": its contour";
  message << " of " << std::setprecision(3) << whole << " m " << (lines.size() > 1 ? "are" : "is")
          << " too long for the tolerance of the menisci: to stay below " << most_triangles
          << " triangles they are off by ";
  if (!solved) message << "up to " << 1e6 * most.height << " um and " << glm::degrees(most.normal) << " degrees, ";
  message << coarseness * coarseness << " times as much as usual";
  std::vector<std::size_t> solids;
  for (const ContactLine& line : lines) solids.push_back(line.solid);
  warnings.push_back({message.str(), std::move(solids)});
  return result;
}

}  // namespace meniscus

// How a film moves: contact vertices on rails, the others along its normals and with them.
#include <algorithm>
#include <cmath>

#include "meniscus/film.h"
#include "meniscus/predicates.h"
#include "meniscus/spine.h"

namespace meniscus {

// `way` in the planes of the fences; upright in a corner.
glm::dvec3 Film::within(const std::vector<glm::dvec3>& fences, const glm::dvec3& way) {
  constexpr double kCorner = 0.01;  // radians
  if (fences.empty()) return way;
  if (fences.size() > 1 && glm::length(glm::cross(fences[0], fences[1])) > kCorner) return {0, way.y, 0};
  return way - glm::dot(way, fences[0]) * fences[0];
}

// The ways in which solids go on as wholes, by contact line.
std::map<std::size_t, glm::dvec3> Film::find_axes() const {
  std::map<std::size_t, std::vector<Strip>> strips;
  for (const ContactVertex& c : contacts_) {
    std::vector<Strip>& line = strips[c.line];
    if (c.next == kNoVertex) continue;
    const ContactVertex& d = contacts_[c.next];
    const double length = glm::distance(vertices_[c.vertex].x, vertices_[d.vertex].x);
    for (const glm::dvec3& normal : {c.rail.after, d.rail.before}) line.push_back({length, normal});
  }
  std::map<std::size_t, glm::dvec3> axes;
  for (const auto& [line, of_line] : strips) axes[line] = glm::normalize(lifted(find_lean(of_line), 1));
  return axes;
}

// Of the contact line, towards the solid; as the contour was in corners and at ends.
double Film::curvature_at(const ContactVertex& c) const {
  if (c.node->joint || c.before == kNoVertex || c.next == kNoVertex) return c.node->contact.curvature;
  const glm::dvec3 x = vertices_[c.vertex].x, in = x - vertices_[contacts_[c.before].vertex].x,
                   out = vertices_[contacts_[c.next].vertex].x - x;
  const double from = glm::length(in), to = glm::length(out);
  return -2 * glm::dot(out / to - in / from, c.rail.mean()) / (from + to);
}

// Makes where the film is what displacements count from.
void Film::rebase(double rail_length) {
  constexpr double kRoom = 1e-3;  // capillary lengths: so near its end a rail has none left
  const std::vector<glm::dvec3> normals = facet_normals();
  for (std::size_t i = 0; i < vertices_.size(); ++i)
    vertices_[i].way = glm::normalize(within(vertices_[i].fences, normals[i]));
  const std::map<std::size_t, glm::dvec3> axes = find_axes();
  for (ContactVertex& c : contacts_) {
    const glm::dvec3 level(0, c.node->position.y, 0);
    c.rail = find_rail(*c.body, *c.node, vertices_[c.vertex].x + level, axes.at(c.line), rail_length);
    c.rail.start -= level;
    c.slide = 0;
    const bool room = c.held > 0 ? c.rail.high > kRoom * length_ : c.rail.low < -kRoom * length_;
    if (room || !c.pinned()) c.held = 0;
  }
  for (Vertex& vertex : vertices_)
    for (const Follow& follow : vertex.follows) {
      const ContactVertex& c = contacts_[follow.contact];
      vertex.x += follow.weight * (c.rail.start - vertices_[c.vertex].x);
    }
  for (const ContactVertex& c : contacts_) vertices_[c.vertex].x = c.rail.start;
  for (ContactVertex& c : contacts_) c.curvature = curvature_at(c);
  shares_.clear();
  for (const glm::uvec3& t : triangles_) {
    const glm::dvec3 p[3] = {vertices_[t.x].x, vertices_[t.y].x, vertices_[t.z].x};
    shares_.push_back(corner_shares(p));
  }
}

Film::State Film::save() const {
  State state{{}, contacts_};
  for (const Vertex& vertex : vertices_) state.x.push_back(vertex.x);
  return state;
}

void Film::restore(const State& state) {
  for (std::size_t i = 0; i < vertices_.size(); ++i) vertices_[i].x = state.x[i];
  contacts_ = state.contacts;
}

// How much of the step, at most, keeps every contact where its rail is known; where the solid itself ends, the line
// stays behind.
double Film::railed(const Eigen::VectorXd& step) const {
  double whole = 1;
  for (const ContactVertex& c : contacts_) {
    const double by = step[c.unknown];
    const bool up = by > 0;
    if (!(up ? c.rail.ends_high : c.rail.ends_low) && by != 0)
      whole = std::min(whole, ((up ? c.rail.high : c.rail.low) - c.slide) / by);
  }
  return whole;
}

// Goes this step; false where a facet turns too far.
bool Film::advance(const Eigen::VectorXd& step, const State& before) {
  constexpr double kTurn = 0.3;  // cosine
  for (ContactVertex& c : contacts_) {
    const double wanted = c.slide + step[c.unknown];
    c.slide = std::clamp(wanted, c.rail.low, c.rail.high);
    if (c.slide != wanted) c.held = wanted > c.slide ? 1 : -1;
    vertices_[c.vertex].x = c.rail.at(c.slide);
  }
  for (Vertex& vertex : vertices_) {
    if (vertex.unknown == kNoVertex) continue;
    vertex.x += step[vertex.unknown] * vertex.way;
    for (const Follow& follow : vertex.follows) {
      const ContactVertex& c = contacts_[follow.contact];
      vertex.x += follow.weight * (c.slide - before.contacts[follow.contact].slide) * c.rail.way;
    }
  }
  return std::all_of(triangles_.begin(), triangles_.end(), [&](const glm::uvec3& t) {
    const glm::dvec3 a = glm::cross(before.x[t.y] - before.x[t.x], before.x[t.z] - before.x[t.x]);
    const glm::dvec3 p = vertices_[t.x].x, b = glm::cross(vertices_[t.y].x - p, vertices_[t.z].x - p);
    return glm::dot(a, b) > kTurn * glm::length(a) * glm::length(b);
  });
}

}  // namespace meniscus

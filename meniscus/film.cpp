#include "meniscus/film.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "meniscus/predicates.h"
#include "meniscus/spine.h"

namespace meniscus {

bool moves(const Sheet::Vertex& vertex, const std::vector<ContactLine>& lines) {
  return vertex.foot.exists() && vertex.foot.distance < lines[vertex.foot.line].sweep && !vertex.crossing;
}

Film::Film(FilmContext& context, const std::vector<std::uint32_t>& triangles, Start start)
    : length_(context.capillary_length) {
  const Sheet& sheet = context.sheet;
  for (const std::uint32_t t : triangles) {
    glm::uvec3& corners = triangles_.emplace_back();
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = sheet.triangles[t][k];
      if (context.local[v] == kNoVertex) {
        context.local[v] = static_cast<std::uint32_t>(vertices_.size());
        const glm::dvec3 base = context.raised.base[v].position;
        const glm::dvec3 at = start == Start::level ? base : context.raised.at[v].position;
        vertices_.push_back({v, at - glm::dvec3(0, base.y, 0)});
      }
      corners[k] = context.local[v];
    }
  }
  for (std::uint32_t i = 0; i < vertices_.size(); ++i) {
    Vertex& vertex = vertices_[i];
    const Sheet::Vertex& s = sheet.vertices[vertex.in_sheet];
    if (!moves(s, context.lines)) continue;
    if (s.node) {
      vertex.contact = static_cast<std::uint32_t>(contacts_.size());
      ContactVertex& c = contacts_.emplace_back();
      c.vertex = i, c.unknown = unknowns_++, c.node = s.node;
      c.line = s.foot.line, c.body = &context.bodies[context.lines[c.line].solid];
      c.rail.before = s.node->before.solid_normal, c.rail.after = s.node->after.solid_normal;
      c.angle = c.wanted = context.angles[s.foot.line][s.foot.node];
    } else {
      vertex.unknown = unknowns_++;
    }
  }
  constexpr std::size_t kRun = 128;  // nodes of a line whose columns are a block
  std::map<std::pair<std::size_t, std::size_t>, std::uint32_t> block_of;
  blocks_.resize(unknowns_);
  for (const Vertex& vertex : vertices_) {
    const std::uint32_t u = vertex.contact == kNoVertex ? vertex.unknown : contacts_[vertex.contact].unknown;
    if (u == kNoVertex) continue;
    const Foot& foot = sheet.vertices[vertex.in_sheet].foot;
    const auto next = static_cast<std::uint32_t>(block_of.size());
    blocks_[u] = block_of.try_emplace({foot.line, foot.node / kRun}, next).first->second;
  }
  link(context);
  fence(context);
  for (const Vertex& vertex : vertices_) context.local[vertex.in_sheet] = kNoVertex;
}

// Sets which contacts are neighbours and which carry a vertex along.
void Film::link(const FilmContext& context) {
  const auto contact_of = [&](std::size_t line, std::size_t node) {
    const std::uint32_t v = context.contact_at[line][node];
    const std::uint32_t local = v == kNoVertex ? v : context.local[v];
    return local == kNoVertex ? local : vertices_[local].contact;
  };
  for (ContactVertex& c : contacts_) {
    const Foot& foot = context.sheet.vertices[vertices_[c.vertex].in_sheet].foot;
    const ContactLine& line = context.lines[foot.line];
    const std::size_t n = line.nodes.size();
    if (line.closed || foot.node + 1 < n) c.next = contact_of(foot.line, (foot.node + 1) % n);
    if (line.closed || foot.node > 0) c.before = contact_of(foot.line, (foot.node + n - 1) % n);
  }
  for (Vertex& vertex : vertices_) {
    if (vertex.unknown == kNoVertex) continue;
    const Sheet::Vertex& s = context.sheet.vertices[vertex.in_sheet];
    for (const Foot* foot : {&s.foot, &s.other}) {
      if (!foot->exists()) continue;
      const ContactLine& line = context.lines[foot->line];
      const double free = foot->from->reach > 0 ? std::min(foot->from->reach, line.sweep) : line.sweep;
      // About as the surface itself answers: it rises as a whole between near walls, and falls off from lone ones.
      const double left = std::max(free - foot->distance, 0.0), share = s.other.exists() ? 0.5 : 1;
      const double upward = share * std::cosh(left / length_) / std::cosh(free / length_);
      const double across = share * left / free;
      const glm::dvec3 weight(across, upward, across);
      const auto follow = [&](std::size_t node, const glm::dvec3& w) {
        const std::uint32_t c = contact_of(foot->line, node);
        if (c != kNoVertex) vertex.follows.push_back({c, w});
      };
      const bool segment = foot->from != foot->to && foot->fan == 0;
      follow(foot->node, segment ? weight * (1 - foot->t) : weight);
      if (segment) follow((foot->node + 1) % line.nodes.size(), weight * foot->t);
    }
  }
}

// Sets in which planes the vertices on the liquid's own border stay.
void Film::fence(const FilmContext& context) {
  const auto on_border = [&](std::uint32_t v) {
    const Sheet::Vertex& s = context.sheet.vertices[vertices_[v].in_sheet];
    return s.border || s.original;
  };
  std::set<std::pair<std::uint32_t, std::uint32_t>> sides;  // of triangles, along the border
  for (const glm::uvec3& t : triangles_)
    for (int k = 0; k < 3; ++k)
      if (on_border(t[k]) && on_border(t[(k + 1) % 3])) sides.emplace(t[k], t[(k + 1) % 3]);
  for (const auto& [a, b] : sides) {
    if (sides.contains({b, a})) continue;
    const glm::dvec3 way = vertices_[b].x - vertices_[a].x;
    const glm::dvec3 normal = glm::normalize(glm::dvec3(way.z, 0, -way.x));
    for (const std::uint32_t v : {a, b}) vertices_[v].fences.push_back(normal);
  }
}

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
    if (c.held > 0 ? !c.rail.ends_high || c.rail.high > kRoom * length_
                   : !c.rail.ends_low || c.rail.low < -kRoom * length_)
      c.held = 0;
  }
  for (Vertex& vertex : vertices_)
    for (const Follow& follow : vertex.follows) {
      const ContactVertex& c = contacts_[follow.contact];
      vertex.x += follow.weight * (c.rail.start - vertices_[c.vertex].x);
    }
  for (const ContactVertex& c : contacts_) vertices_[c.vertex].x = c.rail.start;
  for (ContactVertex& c : contacts_) {
    c.curvature = c.node->contact.curvature;
    if (c.node->joint || c.before == kNoVertex || c.next == kNoVertex) continue;
    const glm::dvec3 x = vertices_[c.vertex].x, in = x - vertices_[contacts_[c.before].vertex].x,
                     out = vertices_[contacts_[c.next].vertex].x - x;
    const double from = glm::length(in), to = glm::length(out);
    c.curvature = -2 * glm::dot(out / to - in / from, c.rail.mean()) / (from + to);
  }
  shares_.clear();
  for (const glm::uvec3& t : triangles_) {
    const glm::dvec3 p[3] = {vertices_[t.x].x, vertices_[t.y].x, vertices_[t.z].x};
    shares_.push_back(corner_shares(p));
  }
}

void Film::ask(double part) {
  for (ContactVertex& c : contacts_) {
    const glm::dvec3 solid = glm::normalize(c.node->before.solid_normal + c.node->after.solid_normal);
    const double level = std::acos(std::clamp(glm::dot(solid, c.node->liquid_normal), -1.0, 1.0));
    c.angle = std::lerp(level, c.wanted, part);
  }
}

double Film::off() const {
  double most = 0;
  for (const ContactVertex& c : contacts_) most = std::max(most, std::abs(c.wanted - c.angle));
  return most;
}

bool Film::vanished() const {
  constexpr double kLeast = 0.05;
  double was = 0, is = 0;  // length
  for (const ContactVertex& c : contacts_) {
    if (c.next == kNoVertex) continue;
    const ContactVertex& d = contacts_[c.next];
    was += glm::distance(c.node->position, d.node->position);
    is += glm::distance(vertices_[c.vertex].x, vertices_[d.vertex].x);
  }
  return is < kLeast * was;
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

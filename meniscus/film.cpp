#include "meniscus/film.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

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

}  // namespace meniscus

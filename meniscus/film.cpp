#include "meniscus/film.h"

#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "meniscus/fitted_normals.h"
#include "meniscus/predicates.h"
#include "meniscus/tension.h"

namespace meniscus {

Film::Film(FilmContext& context, const std::vector<std::uint32_t>& triangles, Start start)
    : length_(context.capillary_length), start_(start) {
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
    if (!s.foot.exists() || !(s.foot.distance < context.lines[s.foot.line].sweep) || s.crossing) continue;
    if (s.node) {
      vertex.contact = static_cast<std::uint32_t>(contacts_.size());
      ContactVertex& c = contacts_.emplace_back();
      c.vertex = i, c.unknown = unknowns_++, c.node = s.node;
      c.body = &context.bodies[context.lines[s.foot.line].solid];
      c.angle = c.body->contact_angle;
      c.slant = std::acos(glm::clamp(glm::dot(s.node->contact.solid_normal, s.node->liquid_normal), -1.0, 1.0));
    } else {
      vertex.unknown = unknowns_++;
      vertex.upright = s.border || s.original;
    }
  }
  link(context);
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
      const double left = std::max(free - foot->distance, 0.0);
      const double weight = (s.other.exists() ? 0.5 : 1) * std::cosh(left / length_) / std::cosh(free / length_);
      const auto follow = [&](std::size_t node, double w) {
        const std::uint32_t c = contact_of(foot->line, node);
        if (c != kNoVertex && w > 0) vertex.follows.push_back({c, w});
      };
      const bool segment = foot->from != foot->to && foot->fan == 0;
      follow(foot->node, segment ? weight * (1 - foot->t) : weight);
      if (segment) follow((foot->node + 1) % line.nodes.size(), weight * foot->t);
    }
  }
}

Film::Outcome Film::solve() {
  if (start_ == Start::raised) return settle();
  constexpr double kLeast = 1.0 / 64;
  Outcome outcome;
  for (double reached = 0, part = 1; reached < 1;) {
    const Film before = *this;
    progress_ = std::min(reached + part, 1.0);
    const int steps = outcome.steps;
    outcome = settle();
    outcome.steps += steps;
    if (outcome.converged) {
      reached = progress_, part *= 2;
      continue;
    }
    *this = before, part /= 2;
    if (part < kLeast) return outcome;
  }
  return outcome;
}

bool Film::upright() const {
  constexpr double kUpright = 0.1;  // radians
  return std::all_of(contacts_.begin(), contacts_.end(),
                     [](const ContactVertex& c) { return std::abs(c.slant - glm::half_pi<double>()) < kUpright; });
}

Film::Outcome Film::settle() {
  constexpr int kRounds = 20, kSteps = 40;
  constexpr double kRail = 0.3, kFar = 0.5;           // capillary lengths
  constexpr double kFacets = 2e-3;                    // what facets' edges may move it by, to and fro
  constexpr double kLeastPart = 0.02;                 // smaller ones are at the end of what a round can do
  constexpr double kPrecise = 1e-7, kSettled = 1e-4;  // of a step; of a round's first
  Outcome outcome;
  double before = 1;
  for (int round = 0; round < kRounds && !outcome.converged; ++round) {
    rebase(kRail * length_);
    double moved = 0;
    bool settled = false;
    for (int k = 0; k < kSteps && moved < kFar; ++k) {
      const Eigen::VectorXd step = newton_step();
      ++outcome.steps;
      if (!step.allFinite()) return outcome;
      outcome.last_step = step.lpNorm<Eigen::Infinity>();
      const double part = advance(step), full = outcome.last_step / length_;
      if (part == 0 && moved == 0) return outcome;
      moved += part * full;
      if (part < kLeastPart) break;
      if (part < 1 || full > kPrecise) continue;  // damped steps are small where nothing has converged
      settled = true;
      break;
    }
    outcome.converged = settled && (moved < kSettled || (moved < kFacets && moved > 0.5 * before));
    before = moved;
  }
  return outcome;
}

// The mean of the facets' normals at each vertex, by the corner's angle.
std::vector<glm::dvec3> Film::facet_normals() const {
  std::vector<glm::dvec3> sums(vertices_.size(), glm::dvec3(0));
  for (const glm::uvec3& t : triangles_) {
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 p = vertices_[t[k]].x, a = vertices_[t[(k + 1) % 3]].x - p, b = vertices_[t[(k + 2) % 3]].x - p;
      const glm::dvec3 n = glm::cross(a, b);
      const double size = glm::length(n);
      if (size > 0) sums[t[k]] += std::atan2(size, glm::dot(a, b)) / size * n;
    }
  }
  for (glm::dvec3& sum : sums) sum = glm::normalize(sum);
  return sums;
}

// Makes where the film is what displacements count from.
void Film::rebase(double rail_length) {
  const std::vector<glm::dvec3> normals = facet_normals();
  for (std::size_t i = 0; i < vertices_.size(); ++i)
    vertices_[i].way = vertices_[i].upright ? glm::dvec3(0, 1, 0) : normals[i];
  for (ContactVertex& c : contacts_) {
    const glm::dvec3 level(0, c.node->position.y, 0);
    c.rail = find_rail(*c.body, *c.node, vertices_[c.vertex].x + level, rail_length);
    c.rail.start -= level;
    c.slide = 0;
    if (!c.pinned()) c.held = 0;
  }
  for (Vertex& vertex : vertices_)
    for (const Follow& follow : vertex.follows) {
      const ContactVertex& c = contacts_[follow.contact];
      vertex.x += follow.weight * (c.rail.start - vertices_[c.vertex].x);
    }
  for (const ContactVertex& c : contacts_) vertices_[c.vertex].x = c.rail.start;
  shares_.clear();
  for (const glm::uvec3& t : triangles_) {
    const glm::dvec3 p[3] = {vertices_[t.x].x, vertices_[t.y].x, vertices_[t.z].x};
    shares_.push_back(corner_shares(p));
  }
}

Eigen::VectorXd Film::newton_step() {
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd force = Eigen::VectorXd::Zero(unknowns_);
  for (std::size_t k = 0; k < triangles_.size(); ++k) {
    const glm::uvec3& t = triangles_[k];
    const glm::dvec3 p[3] = {vertices_[t.x].x, vertices_[t.y].x, vertices_[t.z].x};
    const FacetForces f = facet_forces(p, shares_[k], length_);
    for (int i = 0; i < 3; ++i) {
      const Vertex& vertex = vertices_[t[i]];
      const ContactVertex* contact = vertex.contact == kNoVertex ? nullptr : &contacts_[vertex.contact];
      if (!contact && vertex.unknown == kNoVertex) continue;
      const std::uint32_t row = contact ? contact->unknown : vertex.unknown;
      const glm::dvec3 along = contact ? contact->rail.way_at(contact->slide) : vertex.way;
      force[row] += glm::dot(along, f.on[i]);
      // Between the contact line and the middle of the facet the surface still turns: weight acts along the mean of its
      // normal there, which the contact angle gives, and the facet's.
      double turned = 0, narrowing = 0;
      glm::dvec3 turning(0);
      if (contact) {
        const double angle = angle_at(*contact);
        turned = 0.5 * (std::sin(angle) - glm::dot(f.normal, along));
        force[row] += f.weight[i] * turned;
        const glm::dvec3 solid =
            glm::normalize(contact->rail.before_at(contact->slide) + contact->rail.after_at(contact->slide));
        const double a = glm::dot(f.normal, along), b = glm::dot(f.normal, solid);
        const int j = vertices_[t[(i + 1) % 3]].contact != kNoVertex   ? (i + 1) % 3
                      : vertices_[t[(i + 2) % 3]].contact != kNoVertex ? (i + 2) % 3
                                                                       : -1;
        const double base = j >= 0 ? glm::distance(p[i], p[j]) : glm::distance(p[(i + 1) % 3], p[(i + 2) % 3]);
        const double reach = glm::length(glm::cross(p[1] - p[0], p[2] - p[0])) / base;
        const double pull = glm::dot(along, f.on[i]) - f.weight[i] * a;
        narrowing = contact->node->contact.curvature * b * reach / 4 * pull;
        force[row] -= narrowing * (std::atan2(a, b) - angle);
        turning = -narrowing * (b * along - a * solid);
        entries.emplace_back(row, row, -contact->rail.curvature * glm::dot(contact->rail.mean(), f.on[i]));
      }
      for (int j = 0; j < 3; ++j) {
        glm::dvec3 change = along * f.change[i][j];
        if (contact)
          change += turning * f.turn[j] + turned * f.weight_change[i][j] - 0.5 * f.weight[i] * (along * f.turn[j]);
        const Vertex& moved = vertices_[t[j]];
        if (moved.contact != kNoVertex) {
          const ContactVertex& c = contacts_[moved.contact];
          entries.emplace_back(row, c.unknown, glm::dot(change, c.rail.way_at(c.slide)));
        } else if (moved.unknown != kNoVertex) {
          entries.emplace_back(row, moved.unknown, glm::dot(change, moved.way));
          for (const Follow& follow : moved.follows) {
            const ContactVertex& c = contacts_[follow.contact];
            entries.emplace_back(row, c.unknown, follow.weight * glm::dot(change, c.rail.way));
          }
        }
      }
    }
  }
  add_wetting(force, entries);
  std::vector<bool> fixed(unknowns_, false);
  for (ContactVertex& c : contacts_) {  // held at an end of the rail as long as it is pushed outward
    if (c.held * force[c.unknown] > 0) c.held = 0;
    if (c.held != 0) fixed[c.unknown] = true, force[c.unknown] = 0;
  }
  std::erase_if(entries, [&](const auto& e) { return fixed[e.row()] || fixed[e.col()]; });
  for (std::uint32_t u = 0; u < unknowns_; ++u)
    if (fixed[u]) entries.emplace_back(u, u, 1.0);
  Eigen::SparseMatrix<double> matrix(unknowns_, unknowns_);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseLU<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> factors(matrix);
  if (factors.info() != Eigen::Success) return Eigen::VectorXd::Constant(unknowns_, std::nan(""));
  return factors.solve(-force);
}

// The solid's pull: as the contact line moves up, it wets half of the strip beside each of its edges.
void Film::add_wetting(Eigen::VectorXd& force, std::vector<Eigen::Triplet<double>>& entries) const {
  for (const ContactVertex& c : contacts_) {
    if (c.next == kNoVertex) continue;
    const ContactVertex& d = contacts_[c.next];
    const ContactVertex* ends[2] = {&c, &d};
    const glm::dvec3 edge = vertices_[d.vertex].x - vertices_[c.vertex].x;
    const glm::dvec3 ways[2] = {c.rail.way_at(c.slide), d.rail.way_at(d.slide)};
    // Smooth normals of a faceted solid lean along its facets: what is wetted is as wide as the edge is long.
    glm::dvec3 sum = c.rail.after_at(c.slide) + d.rail.before_at(d.slide);
    sum -= glm::dot(sum, edge) / glm::dot(edge, edge) * edge;
    const double size = glm::length(sum), pull = -0.5 * std::cos(angle_at(c));
    const glm::dvec3 normal = sum / size;  // to the left of the edge, where the liquid is
    for (int i = 0; i < 2; ++i) {
      force[ends[i]->unknown] += pull * glm::dot(normal, glm::cross(ways[i], edge));
      for (int j = 0; j < 2; ++j) {
        const Rail& rail = ends[j]->rail;
        double change = glm::dot(normal, glm::cross(ways[i], (j == 0 ? -1.0 : 1.0) * ways[j])) +
                        rail.curvature / size * glm::dot(ways[j], glm::cross(ways[i], edge));
        if (i == j) change -= rail.curvature * glm::dot(normal, glm::cross(rail.mean(), edge));
        entries.emplace_back(ends[i]->unknown, ends[j]->unknown, pull * change);
      }
    }
  }
}

// Goes as large a part of the step as turns no facet too far, and returns it; 0 where there is none.
double Film::advance(const Eigen::VectorXd& step) {
  constexpr double kTurn = 0.3, kLeast = 1e-3;  // cosine; part
  const std::vector<Vertex> was = vertices_;
  const std::vector<ContactVertex> were = contacts_;
  double whole = 1;  // no farther on any rail than it is known; where the solid itself ends, the line stays behind
  for (const ContactVertex& c : contacts_) {
    const double by = step[c.unknown];
    const bool up = by > 0;
    if (!(up ? c.rail.ends_high : c.rail.ends_low) && by != 0)
      whole = std::min(whole, ((up ? c.rail.high : c.rail.low) - c.slide) / by);
  }
  for (double part = whole; part > kLeast * whole; part *= 0.5) {
    for (ContactVertex& c : contacts_) {
      const double wanted = c.slide + part * step[c.unknown];
      c.slide = std::clamp(wanted, c.rail.low, c.rail.high);
      if (c.slide != wanted) c.held = wanted > c.slide ? 1 : -1;
      vertices_[c.vertex].x = c.rail.at(c.slide);
    }
    for (Vertex& vertex : vertices_) {
      if (vertex.unknown == kNoVertex) continue;
      vertex.x += part * step[vertex.unknown] * vertex.way;
      for (const Follow& follow : vertex.follows) {
        const ContactVertex& c = contacts_[follow.contact];
        vertex.x += follow.weight * (c.slide - were[follow.contact].slide) * c.rail.way;
      }
    }
    const bool sound = std::all_of(triangles_.begin(), triangles_.end(), [&](const glm::uvec3& t) {
      const auto normal = [&](const std::vector<Vertex>& at) {
        return glm::cross(at[t.y].x - at[t.x].x, at[t.z].x - at[t.x].x);
      };
      const glm::dvec3 a = normal(was), b = normal(vertices_);
      return glm::dot(a, b) > kTurn * glm::length(a) * glm::length(b);
    });
    if (sound) return part;
    vertices_ = was, contacts_ = were;
  }
  return 0;
}

// Fitted to the film; where the contact angle is met, as it asks.
std::vector<glm::dvec3> Film::normals() const {
  std::vector<glm::dvec3> positions;
  for (const Vertex& vertex : vertices_) positions.push_back(vertex.x);
  std::vector<glm::dvec3> normals = fit_normals(positions, triangles_, facet_normals());
  for (const ContactVertex& c : contacts_) {
    if (c.held != 0 || c.node->joint || c.next == kNoVertex || c.before == kNoVertex) continue;
    const glm::dvec3 solid = glm::normalize(c.rail.before_at(c.slide));
    const glm::dvec3 along = vertices_[contacts_[c.next].vertex].x - vertices_[contacts_[c.before].vertex].x;
    const glm::dvec3 up = glm::normalize(glm::cross(solid, along));
    const double angle = c.angle;
    normals[c.vertex] = std::cos(angle) * solid + std::sin(angle) * up;
  }
  return normals;
}

std::vector<Film::Point> Film::points() const {
  const std::vector<glm::dvec3> all = normals();
  std::vector<Point> result;
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    const Vertex& vertex = vertices_[i];
    if (vertex.unknown == kNoVertex && vertex.contact == kNoVertex) continue;
    // Back on the facet, so that no light slips in between.
    const glm::dvec3 bulge = vertex.contact == kNoVertex ? glm::dvec3(0) : contacts_[vertex.contact].rail.bulge;
    result.push_back({vertex.in_sheet, {vertex.x - bulge, all[i]}});
  }
  return result;
}

double Film::sagitta() const {
  const std::vector<glm::dvec3> at = normals();
  double most = 0;
  for (const glm::uvec3& t : triangles_) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      most = std::max(most, std::abs(glm::dot(at[b] - at[a], vertices_[b].x - vertices_[a].x)) / 8);
    }
  }
  return most;
}

std::vector<std::uint32_t> Film::pinned() const {
  std::vector<std::uint32_t> result;
  for (const ContactVertex& c : contacts_)
    if (c.pinned()) result.push_back(vertices_[c.vertex].in_sheet);
  return result;
}

}  // namespace meniscus

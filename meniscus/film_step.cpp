// The equations of a film: the forces on its unknowns and their derivatives.
#include <algorithm>
#include <cmath>

#include "meniscus/film.h"

namespace meniscus {

// What the facets next to the contact line lack: there the surface is an arc that turns from the contact angle to the
// facet's slope in its middle. Weight acts along the mean of the two, and the arc's middle, where the film pulls, lies
// below the chord's, where a strip round a post is narrower. Without this, angles near 0 and 180 degrees are off by as
// much as the first facet turns.
Film::FirstFacet Film::first_facet(const ContactVertex& c, const FacetForces& f, const glm::dvec3 p[3], int i,
                                   const glm::uvec3& t) const {
  const double angle = c.angle;
  const glm::dvec3 along = c.rail.way_at(c.slide);
  const glm::dvec3 solid = glm::normalize(c.rail.before_at(c.slide) + c.rail.after_at(c.slide));
  const double rise = glm::dot(f.normal, along), out = glm::dot(f.normal, solid);
  const int next = (i + 1) % 3, last = (i + 2) % 3;
  const auto on_line = [&](int k) { return vertices_[t[k]].contact != kNoVertex; };
  const double base = on_line(next)   ? glm::distance(p[i], p[next])
                      : on_line(last) ? glm::distance(p[i], p[last])
                                      : glm::distance(p[next], p[last]);
  const double reach = glm::length(glm::cross(p[1] - p[0], p[2] - p[0])) / base;
  const double pull = glm::dot(along, f.on[i]) - f.weight[i] * rise;
  const double narrowing = c.curvature * out * reach / 4 * pull;  // per angle turned
  const double missing = 0.5 * (std::sin(angle) - rise);
  return {f.weight[i] * missing - narrowing * (std::atan2(rise, out) - angle), missing,
          -narrowing * (out * along - rise * solid) - 0.5 * f.weight[i] * along,
          c.rail.curvature * (narrowing * (out * out + rise * rise) + 0.5 * f.weight[i] * out)};
}

Film::Equations Film::equations() const {
  Equations result{Eigen::VectorXd::Zero(unknowns_), {}};
  auto& [force, entries] = result;
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
      FirstFacet first;
      if (contact) {
        first = first_facet(*contact, f, p, i, t);
        force[row] += first.force;
        entries.emplace_back(row, row,
                             first.by_slide - contact->rail.curvature * glm::dot(contact->rail.mean(), f.on[i]));
      }
      for (int j = 0; j < 3; ++j) {
        const glm::dvec3 change =
            along * f.change[i][j] + first.by_normal * f.turn[j] + first.by_weight * f.weight_change[i][j];
        const Vertex& moved = vertices_[t[j]];
        if (moved.contact != kNoVertex) {
          const ContactVertex& c = contacts_[moved.contact];
          entries.emplace_back(row, c.unknown, glm::dot(change, c.rail.way_at(c.slide)));
        } else if (moved.unknown != kNoVertex) {
          entries.emplace_back(row, moved.unknown, glm::dot(change, moved.way));
          for (const Follow& follow : moved.follows) {
            const ContactVertex& c = contacts_[follow.contact];
            entries.emplace_back(row, c.unknown, glm::dot(change, follow.weight * c.rail.way));
          }
        }
      }
    }
  }
  add_wetting(result);
  return result;
}

// The solid's pull: as the contact line moves up, it wets half of the strip beside each of its edges.
void Film::add_wetting(Equations& result) const {
  auto& [force, entries] = result;
  for (const ContactVertex& c : contacts_) {
    if (c.next == kNoVertex) continue;
    const ContactVertex& d = contacts_[c.next];
    const ContactVertex* ends[2] = {&c, &d};
    const glm::dvec3 edge = vertices_[d.vertex].x - vertices_[c.vertex].x;
    const glm::dvec3 ways[2] = {c.rail.way_at(c.slide), d.rail.way_at(d.slide)};
    // Smooth normals of a faceted solid lean along its facets: what is wetted is as wide as the edge is long.
    glm::dvec3 sum = c.rail.after_at(c.slide) + d.rail.before_at(d.slide);
    sum -= glm::dot(sum, edge) / glm::dot(edge, edge) * edge;
    const double size = glm::length(sum), pull = -0.25 * (std::cos(c.angle) + std::cos(d.angle));
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

}  // namespace meniscus

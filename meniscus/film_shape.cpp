// What a film looks like: normals, positions, facets' distance from the surface.
#include <algorithm>
#include <cmath>

#include "meniscus/film.h"
#include "meniscus/fitted_normals.h"

namespace meniscus {

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
    normals[c.vertex] = std::cos(c.angle) * solid + std::sin(c.angle) * up;
  }
  return normals;
}

Film::Shape Film::shape() const {
  const std::vector<glm::dvec3> at = normals();
  Shape shape;
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    const Vertex& vertex = vertices_[i];
    if (vertex.unknown == kNoVertex && vertex.contact == kNoVertex) continue;
    // Back on the facet, so that no light slips in between.
    const glm::dvec3 bulge = vertex.contact == kNoVertex ? glm::dvec3(0) : contacts_[vertex.contact].rail.bulge;
    shape.points.push_back({vertex.in_sheet, {vertex.x - bulge, at[i]}});
  }
  for (const glm::uvec3& t : triangles_) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      const double sagitta = std::abs(glm::dot(at[b] - at[a], vertices_[b].x - vertices_[a].x)) / 8;
      shape.sagitta = std::max(shape.sagitta, sagitta);
    }
  }
  return shape;
}

std::vector<std::uint32_t> Film::pinned() const {
  std::vector<std::uint32_t> result;
  for (const ContactVertex& c : contacts_)
    if (c.pinned()) result.push_back(vertices_[c.vertex].in_sheet);
  return result;
}

}  // namespace meniscus

// A solid and the rays that find where it is.
#pragma once

#include <optional>
#include <string>

#include "meniscus/topology.h"

namespace meniscus {

// A solid, oriented outward, with the tree for its rays.
struct Body {
  std::string name;
  Topology mesh;
  Tree tree;
  double contact_angle;
};

struct Hit {
  glm::dvec3 position;
  glm::dvec3 facet;   // unit normal of the facet
  glm::dvec3 normal;  // unit, interpolated between the facet's corners
  glm::dvec3 smooth;  // on the curved surface that has the corners' normals and stands for a smooth facet
};

// Where the solid is met from `origin` along +-`direction` (unit): the facet, facing `direction`, that is nearest to
// `expected` metres along it, none farther than `reach`. Facets have closed edges: a ray cannot slip between them.
std::optional<Hit> shoot(const Body& body, const glm::dvec3& origin, const glm::dvec3& direction, double expected,
                         double reach);

// The point of the solid nearest to `origin` on the plane through it with normal `up`, on facets that face `direction`,
// within `reach`.
struct Nearest {
  Hit hit;
  bool origin_inside;  // of the facet's plane
};
std::optional<Nearest> nearest_at_height(const Body& body, const glm::dvec3& origin, const glm::dvec3& up,
                                         const glm::dvec3& direction, double reach);

// How far p lies within the solid, 0 outside of it: by the facets above it, from which the nearest is sought.
double depth_within(const Body& body, const glm::dvec3& p);

// The point of triangle t, and of the whole solid, that is nearest to p.
glm::dvec3 nearest_on_triangle(const Topology& mesh, std::uint32_t t, const glm::dvec3& p);
Hit nearest_on_solid(const Body& body, const glm::dvec3& p);

}  // namespace meniscus

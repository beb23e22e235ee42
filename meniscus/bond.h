// Raises a contact line on its solid and bonds it there by ray tests (paper, section 3.2 and figure 6).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "meniscus/columns.h"
#include "meniscus/meniscus.h"

namespace meniscus {

// A solid, oriented outward, with the tree for its rays.
struct Body {
  std::string name;
  Topology mesh;
  Tree tree;
  double contact_angle;
};

// Where the solid is met from `origin` along +-`direction` (unit): the facet, facing `direction`, that is nearest to
// `expected` metres along it, none farther than `reach`. Facets have closed edges: a ray cannot slip between them.
std::optional<glm::dvec3> shoot(const Body& body, const glm::dvec3& origin, const glm::dvec3& direction,
                                double expected, double reach);

// The point of the solid nearest to `origin` on the plane through it with normal `up`, on facets that face `direction`,
// within `reach`.
struct Nearest {
  glm::dvec3 position;
  bool origin_inside;  // of the facet's plane
};
std::optional<Nearest> nearest_at_height(const Body& body, const glm::dvec3& origin, const glm::dvec3& up,
                                         const glm::dvec3& direction, double reach);

// Sets rise and slide of every node: the rise from the height rule, the slide so that the contact vertex lies on the
// solid: along the direction in which the solid leans as a whole, then by a ray along the contour normal. Where the
// solid ends below (or above) the height, the line is pinned at its edge, with a warning. At joints the rise is the
// mean of both sides' and fades into theirs, as does the joint's slide along the line. Sets sweep to 0 where nothing
// rises.
void bond(ContactLine& line, const Body& body, const Liquid& liquid, std::vector<std::string>& warnings);

}  // namespace meniscus

// Surface tension and weight on one facet of a liquid's surface, as forces on its corners.
#pragma once

#include <glm/glm.hpp>

namespace meniscus {

// Per unit of surface tension; lengths in any unit in which the capillary length is `capillary_length`, heights y above
// the level at which the pressure is the air's. The forces are those by which the energy, area + integral of y^2 / (2
// L^2) over the projected area, grows when corners move (Young-Laplace: physics in which they cancel at every vertex).
struct FacetForces {
  glm::dvec3 on[3];         // corner i
  glm::dmat3 change[3][3];  // of the force on corner i per displacement of corner j
  glm::dvec3 normal;        // of the facet
  glm::dmat3 turn[3];       // of the normal per displacement of a corner
  double weight[3];         // the size of that part of the force that is weight; it acts along the normal
  glm::dvec3 weight_change[3][3];
};
// `shares`: the parts of the facet whose weight each corner bears; see corner_shares.
FacetForces facet_forces(const glm::dvec3 corners[3], const glm::dvec3& shares, double capillary_length);

// The parts of a facet that are nearest to each of its corners, half of it at an obtuse one (Meyer, Desbrun, Schroeder,
// Barr 2003): on a grid they do not depend on which diagonals it has, where thirds do.
glm::dvec3 corner_shares(const glm::dvec3 corners[3]);

}  // namespace meniscus

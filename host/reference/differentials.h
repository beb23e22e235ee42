// How a path's place and direction change with where it starts: Igehy, "Tracing Ray Differentials",
// SIGGRAPH 1999; carried by photons as in Schjoth et al., "Photon Differentials", 2007. They give each photon a
// footprint of its own.
#pragma once

#include <array>
#include <initializer_list>

#include "host/reference/tracer.h"

namespace meniscal::reference {

// Of a photon: along two perpendicular directions in its target's facet, per metre, or on its light; of a camera path:
// per pixel.
struct Differential {
  std::array<glm::dvec3, 2> place{}, direction{};
};

// Two unit vectors that make a right-handed frame with `n`; the GPU's.
std::array<glm::dvec3, 2> tangents(const glm::dvec3& n);

// At the start: places differ within the facet; directions as the light's do: not at all from far away, about a point
// at `distance`.
Differential start_differential(const glm::dvec3& facet_normal, const glm::dvec3& direction, double distance);

// While the start stays, and the point on an extended light moves along two perpendicular directions in its facet, per
// `extent`: the part of its distance, rad.
Differential light_differential(const glm::dvec3& light_normal, double extent, const glm::dvec3& direction);

// Derivative of the interpolated unit shading normal along the place's derivatives, at a point of `triangle` where it
// is `shading`.
std::array<glm::dvec3, 2> normal_differential(const WorldTriangle& triangle, const Hit& hit, const Differential& d);

// `normal` on the side of arrival, `dn` its derivative; `direction` is the one of arrival. Places stay.
void reflect(Differential& d, const glm::dvec3& direction, const glm::dvec3& normal,
             const std::array<glm::dvec3, 2>& dn);
void refract(Differential& d, const glm::dvec3& direction, const glm::dvec3& normal,
             const std::array<glm::dvec3, 2>& dn, double eta);

// Over `distance` along `direction` onto a plane with this normal.
void transfer(Differential& d, const glm::dvec3& direction, double distance, const glm::dvec3& plane);

// An elliptic disc on the receiving surface, as the vectors whose products with an offset x give its place in the unit
// disc: q^2 = (alpha x)^2 + (beta x)^2. Its area is pi / |alpha x beta|.
struct Footprint {
  glm::dvec3 alpha, beta;
};

// Area that the parallelogram of the two derivatives of place spans.
double spread(const Differential& d);

// Part of a disc: `reach` is the half-width in the units that the differential is per.
struct Reaching {
  Differential differential;
  double reach;
};

// The disc with the sum of the variances of all parts; its half-widths are clamped to [narrowest, widest].
Footprint make_footprint(std::initializer_list<Reaching> parts, const glm::dvec3& normal, double narrowest,
                         double widest);

}  // namespace meniscal::reference

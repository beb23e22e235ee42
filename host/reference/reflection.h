// Reflection by an opaque surface: an outer face that is smooth or rough by GGX, and Lambert's below it, which gets
// what the face lets through (after glTF 2.0, appendix B; Walter et al., "Microfacet Models for Refraction through
// Rough Surfaces", EGSR 2007). The specification of shaders/reflection.glsl. Directions are unit vectors away from the
// surface.
#pragma once

#include <glm/glm.hpp>

#include "shaders/shared/structs.h"

namespace meniscal::reference {

// The outer face of a surface, seen from `outgoing`.
struct Face {
  glm::dvec3 normal, outgoing;  // normal: shading, unit, on the side of `outgoing`
  double alpha;                 // of GGX; 0: smooth
  glm::dvec3 f0;                // reflectance straight on
  double f90;                   // and grazing
};
// `side`: the geometric normal on the side of `outgoing`, which stands in for a shading normal on the other side.
Face make_face(const shared::Surface& surface, const glm::dvec3& shading, const glm::dvec3& side,
               const glm::dvec3& outgoing);

// Schlick's reflectance of a facet that is met at this cosine.
glm::dvec3 reflectance(const Face& face, double cosine);
inline double largest(const glm::dvec3& c) { return glm::max(c.x, glm::max(c.y, c.z)); }

// The face's own lobe, 1/sr, without the cosine; 0 where it is smooth.
glm::dvec3 lobe(const Face& face, const glm::dvec3& incoming);
// What the face makes of the light of Lambert's surface below, which it lets through twice: a factor.
double passed(const Face& face, const glm::dvec3& incoming);
// All that is reflected more than by `albedo` / pi, 1/sr; `lobe_part`: of the lobe that counts, 0 to 1.
glm::dvec3 beyond_lambert(const Face& face, const glm::dvec3& albedo, const glm::dvec3& incoming, double lobe_part);

// A direction by the lobe, from `place` in the unit square, and lobe * cosine / pdf; 0 where it is below the surface.
struct LobeSample {
  glm::dvec3 incoming, weight;
};
LobeSample sample_lobe(const Face& face, const glm::dvec2& place);
// The density of that, 1/sr.
double lobe_pdf(const Face& face, const glm::dvec3& incoming);
// Of a path that is scattered there: the probability that it is by the lobe.
double lobe_probability(const Face& face, const glm::dvec3& albedo);

// The normal of a microfacet that is seen from `outgoing`, by its part of what is seen.
glm::dvec3 visible_normal(const glm::dvec3& normal, const glm::dvec3& outgoing, double alpha, const glm::dvec2& place);
// Part of the microfacets towards a direction at this cosine that others do not hide (Smith).
double unhidden(double cosine, double alpha);

}  // namespace meniscal::reference

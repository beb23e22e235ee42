// Reflection by an opaque surface: an outer face that is smooth or rough by GGX, and Lambert's below it, which gets what the face lets
// through (after glTF 2.0, appendix B; Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007). Directions are unit
// vectors away from the surface.
#include "shared/material.h"

// The outer face of a surface, seen from `outgoing`.
struct Face {
  vec3 normal, outgoing;  // normal: shading, on the side of `outgoing`
  float alpha;            // of GGX; 0: smooth
  vec3 f0;                // reflectance straight on
  float f90;              // and grazing
};

const float PI = 3.14159265358979;

float largest(vec3 c) { return max(c.x, max(c.y, c.z)); }

// Of a facet that is met at this cosine.
vec3 reflectance(Face face, float cosine) { return schlick(face.f0, face.f90, cosine); }

// Of microfacet normals round the surface's: per solid angle, over their projected area. By the sine, which keeps its digits near the
// normal.
float facets(vec3 normal, vec3 facet, float alpha) {
  vec3 across = cross(normal, facet);
  float along = alpha * dot(normal, facet), sum = along * along + dot(across, across);
  return alpha * alpha / (PI * sum * sum);
}

// sqrt(cosine^2 + alpha^2 sine^2): the slanted cosine of Smith's functions.
float slanted(float cosine, float alpha) { return sqrt(alpha * alpha + (1.0 - alpha * alpha) * cosine * cosine); }

// The face's own lobe, 1/sr, without the cosine; 0 where it is smooth.
vec3 lobe(Face face, vec3 incoming) {
  float leaving = dot(face.normal, face.outgoing), arriving = dot(face.normal, incoming);
  if (face.alpha == 0.0 || leaving <= 0.0 || arriving <= 0.0) return vec3(0.0);
  vec3 facet = normalize(face.outgoing + incoming);
  // Smith's masking and shadowing, correlated by height, over 4 cosines (Heitz, JCGT 2014, eq. 99).
  float visible = 0.5 / (arriving * slanted(leaving, face.alpha) + leaving * slanted(arriving, face.alpha));
  return reflectance(face, dot(facet, face.outgoing)) * (facets(face.normal, facet, face.alpha) * visible);
}

// What the face makes of the light of Lambert's surface below, which it lets through twice: a factor. Shirley et al., "A Practitioners'
// Assessment of Light Reflection Models", Pacific Graphics 1997: over all `incoming` it is what the face does not reflect.
float passed(Face face, vec3 incoming) {
  float straight = largest(face.f0), mean = straight + (face.f90 - straight) / 21.0;  // Schlick's, by the cosine
  float leaving = 1.0 - largest(reflectance(face, dot(face.normal, face.outgoing)));
  float arriving = 1.0 - largest(reflectance(face, dot(face.normal, incoming)));
  return leaving * arriving / max(1.0 - mean, 1e-6);
}

// All that is reflected more than by `albedo` / pi, 1/sr; `lobe_part`: of the lobe that counts, 0 to 1.
vec3 beyond_lambert(Face face, vec3 albedo, vec3 incoming, float lobe_part) {
  return lobe_part * lobe(face, incoming) + (passed(face, incoming) - 1.0) / PI * albedo;
}

// The density with which sample_lobe takes a direction, 1/sr.
float lobe_pdf(Face face, vec3 incoming) {
  float leaving = dot(face.normal, face.outgoing);
  if (face.alpha == 0.0 || leaving <= 0.0) return 0.0;
  vec3 facet = normalize(face.outgoing + incoming);
  return facets(face.normal, facet, face.alpha) / (2.0 * (leaving + slanted(leaving, face.alpha)));
}

// Of a path that is scattered there: the probability that it is by the lobe.
float lobe_probability(Face face, vec3 albedo) {
  float by_face = face.alpha > 0.0 ? largest(reflectance(face, dot(face.normal, face.outgoing))) : 0.0;
  float below = (1.0 - by_face) * largest(albedo);
  return by_face > 0.0 && below > 0.0 ? clamp(by_face / (by_face + below), 0.1, 0.9) : by_face > 0.0 ? 1.0 : 0.0;
}

// (cosine, sine) of a part of a full circle, to 1e-7: Vulkan lets drivers be off by 5e-4.
vec2 circle(float turn) {
  float quarter = round(4.0 * turn), x = 6.283185307179586 * (turn - 0.25 * quarter), x2 = x * x;
  float c = 1.0 - x2 * (1.0 / 2.0 - x2 * (1.0 / 24.0 - x2 * (1.0 / 720.0 - x2 / 40320.0)));
  float s = x * (1.0 - x2 * (1.0 / 6.0 - x2 * (1.0 / 120.0 - x2 * (1.0 / 5040.0 - x2 / 362880.0))));
  int quadrant = int(quarter) & 3;
  vec2 p = (quadrant & 1) != 0 ? vec2(-s, c) : vec2(c, s);
  return (quadrant & 2) != 0 ? -p : p;
}

vec3 tangent(vec3 n) { return normalize(abs(n.x) > 0.6 ? vec3(n.z, 0.0, -n.x) : vec3(0.0, -n.z, n.y)); }

// The normal of a microfacet that is seen from `outgoing`, by its part of what is seen: Dupuy and Benyoub, "Sampling Visible GGX Normals
// with Spherical Caps", HPG 2023.
vec3 visible_normal(vec3 normal, vec3 outgoing, float alpha, vec2 place) {
  vec3 u = tangent(normal), v = cross(normal, u);
  vec3 view = normalize(vec3(alpha * dot(u, outgoing), alpha * dot(v, outgoing), dot(normal, outgoing)));
  float z = (1.0 - place.y) * (1.0 + view.z) - view.z;
  float sine = sqrt(clamp(1.0 - z * z, 0.0, 1.0));
  vec3 h = vec3(sine * circle(place.x), z) + view;
  return normalize(alpha * h.x * u + alpha * h.y * v + max(h.z, 0.0) * normal);
}

// Part of the microfacets towards a direction at this cosine that others do not hide (Smith).
float unhidden(float cosine, float alpha) { return 2.0 * cosine / (cosine + slanted(cosine, alpha)); }

// A direction by the lobe, from `place` in the unit square; `weight`: lobe * cosine / pdf, 0 where it is below the surface.
vec3 sample_lobe(Face face, vec2 place, out vec3 weight) {
  vec3 facet = visible_normal(face.normal, face.outgoing, face.alpha, place);
  float met = dot(facet, face.outgoing);
  vec3 incoming = 2.0 * met * facet - face.outgoing;
  float leaving = dot(face.normal, face.outgoing), arriving = dot(face.normal, incoming);
  float s_leaving = slanted(leaving, face.alpha), s_arriving = slanted(arriving, face.alpha);
  float seen = arriving * (leaving + s_leaving) / (arriving * s_leaving + leaving * s_arriving);
  weight = arriving > 0.0 ? reflectance(face, met) * seen : vec3(0.0);
  return incoming;
}

#include "host/reference/reflection.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "host/reference/differentials.h"

namespace meniscal::reference {
namespace {

constexpr double pi = glm::pi<double>();

double square(double x) { return x * x; }

// Of microfacet normals round the surface's: per solid angle, over their projected area.
double facets(const glm::dvec3& normal, const glm::dvec3& facet, double alpha) {
  const glm::dvec3 across = glm::cross(normal, facet);
  return square(alpha) / (pi * square(square(alpha * glm::dot(normal, facet)) + glm::dot(across, across)));
}

// sqrt(cosine^2 + alpha^2 sine^2): the slanted cosine of Smith's functions.
double slanted(double cosine, double alpha) { return std::sqrt(square(alpha) + (1 - square(alpha)) * square(cosine)); }

}  // namespace

Face make_face(const shared::Surface& surface, const glm::dvec3& shading, const glm::dvec3& side,
               const glm::dvec3& outgoing) {
  return {glm::dot(shading, outgoing) > 0 ? shading : side, outgoing, double(surface.alpha), glm::dvec3(surface.f0),
          double(surface.f90)};
}

glm::dvec3 reflectance(const Face& face, double cosine) {
  return face.f0 + (face.f90 - face.f0) * std::pow(glm::clamp(1 - cosine, 0.0, 1.0), 5);
}

glm::dvec3 lobe(const Face& face, const glm::dvec3& incoming) {
  const double out = glm::dot(face.normal, face.outgoing), in = glm::dot(face.normal, incoming);
  if (face.alpha == 0 || out <= 0 || in <= 0) return glm::dvec3(0);
  const glm::dvec3 facet = glm::normalize(face.outgoing + incoming);
  // Smith's masking and shadowing, correlated by height, over 4 cosines (Heitz, JCGT 2014, eq. 99).
  const double visible = 0.5 / (in * slanted(out, face.alpha) + out * slanted(in, face.alpha));
  return reflectance(face, glm::dot(facet, face.outgoing)) * facets(face.normal, facet, face.alpha) * visible;
}

double passed(const Face& face, const glm::dvec3& incoming) {
  // Shirley et al., "A Practitioners' Assessment of Light Reflection Models", Pacific Graphics 1997: over all
  // `incoming` it is what the face does not reflect, so that both together reflect all light where nothing is absorbed.
  const double straight = largest(face.f0), mean = straight + (face.f90 - straight) / 21;  // Schlick's, by the cosine
  const double out = 1 - largest(reflectance(face, glm::dot(face.normal, face.outgoing)));
  const double in = 1 - largest(reflectance(face, glm::dot(face.normal, incoming)));
  return out * in / std::max(1 - mean, 1e-6);
}

glm::dvec3 beyond_lambert(const Face& face, const glm::dvec3& albedo, const glm::dvec3& incoming, double lobe_part) {
  return lobe_part * lobe(face, incoming) + (passed(face, incoming) - 1) / pi * albedo;
}

LobeSample sample_lobe(const Face& face, const glm::dvec2& place) {
  const glm::dvec3 facet = visible_normal(face.normal, face.outgoing, face.alpha, place);
  const double met = glm::dot(facet, face.outgoing);
  const glm::dvec3 incoming = 2 * met * facet - face.outgoing;
  const double out = glm::dot(face.normal, face.outgoing), in = glm::dot(face.normal, incoming);
  if (in <= 0) return {incoming, glm::dvec3(0)};
  const double s_out = slanted(out, face.alpha), s_in = slanted(in, face.alpha);
  return {incoming, reflectance(face, met) * (in * (out + s_out) / (in * s_out + out * s_in))};
}

double lobe_pdf(const Face& face, const glm::dvec3& incoming) {
  const double out = glm::dot(face.normal, face.outgoing);
  if (face.alpha == 0 || out <= 0) return 0;
  const glm::dvec3 facet = glm::normalize(face.outgoing + incoming);
  return facets(face.normal, facet, face.alpha) / (2 * (out + slanted(out, face.alpha)));
}

double lobe_probability(const Face& face, const glm::dvec3& albedo) {
  const double by_face = face.alpha > 0 ? largest(reflectance(face, glm::dot(face.normal, face.outgoing))) : 0;
  const double below = (1 - by_face) * largest(albedo);
  return by_face > 0 && below > 0 ? glm::clamp(by_face / (by_face + below), 0.1, 0.9) : by_face > 0 ? 1 : 0;
}

glm::dvec3 visible_normal(const glm::dvec3& normal, const glm::dvec3& outgoing, double alpha, const glm::dvec2& place) {
  // Dupuy and Benyoub, "Sampling Visible GGX Normals with Spherical Caps", HPG 2023.
  const auto [u, v] = tangents(normal);
  const glm::dvec3 view = glm::normalize(
      glm::dvec3(alpha * glm::dot(u, outgoing), alpha * glm::dot(v, outgoing), glm::dot(normal, outgoing)));
  const double turn = 2 * pi * place.x, z = (1 - place.y) * (1 + view.z) - view.z;
  const double sine = std::sqrt(glm::clamp(1 - z * z, 0.0, 1.0));
  const glm::dvec3 h = glm::dvec3(sine * std::cos(turn), sine * std::sin(turn), z) + view;
  return glm::normalize(alpha * h.x * u + alpha * h.y * v + glm::max(h.z, 0.0) * normal);
}

double unhidden(double cosine, double alpha) { return 2 * cosine / (cosine + slanted(cosine, alpha)); }

}  // namespace meniscal::reference

#include "host/reference/scattering.h"

#include <cmath>

#include "shaders/shared/material.h"

namespace meniscal::reference {
namespace {

double lobe_probability(const DiffusePoint& point, Lobes lobes) {
  if (!point.glossy) return 0;
  const double probability = lobe_probability(point.face, glm::dvec3(point.surface.albedo));
  return lobes == Lobes::gloss ? std::ceil(probability) : probability;
}

}  // namespace

DiffusePoint::DiffusePoint(const World& world, const Hit& h, const shared::Surface& s, const glm::dvec3& arrival)
    : hit(h), surface(s), glossy(shared::is_glossy(s)) {
  const glm::dvec3& geometric = world.triangles[hit.triangle].geometric;
  const bool front = glm::dot(geometric, arrival) < 0;
  side = front ? geometric : -geometric;
  shading = front ? hit.shading : -hit.shading;
  face = make_face(surface, shading, side, -arrival);
}

Scattering scatter(const Tracer& tracer, Path& path, const DiffusePoint& point, const glm::dvec3& normal, Lobes lobes,
                   double choice, const glm::dvec2& place) {
  const double probability = lobe_probability(point, lobes);
  Scattering how{.goes_on = false, .by_lobe = choice < probability};
  if (!how.by_lobe && lobes == Lobes::gloss) return how;
  glm::dvec3 direction;
  if (how.by_lobe) {
    const LobeSample sample = sample_lobe(point.face, place);
    direction = sample.incoming;
    how.pdf = probability * lobe_pdf(point.face, direction);
    path.throughput *= sample.weight / probability;
  } else {
    direction = around(normal, std::sqrt(place.x), std::sqrt(1 - place.x), place.y);
    if (point.glossy) how.passed = passed(point.face, direction);
    path.throughput *= glm::dvec3(point.surface.albedo) * (how.passed / (1 - probability) / path.let_through);
  }
  how.goes_on = glm::dot(direction, point.side) > 0 && path.throughput != glm::dvec3(0);
  path.let_through = 1;
  path.ray = {tracer.leave(point.hit.point, point.side), direction};
  path.triangle = point.hit.triangle;
  path.differential = path.by_light = {};
  return how;
}

double scattering_pdf(const DiffusePoint& point, Lobes lobes, const glm::dvec3& direction) {
  return point.glossy ? lobe_probability(point, lobes) * lobe_pdf(point.face, direction) : 0;
}

}  // namespace meniscal::reference

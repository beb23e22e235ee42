// What both kinds of path do at diffuse surfaces: go on, by Lambert's law or by the lobe of a rough outer face.
#pragma once

#include "host/reference/path.h"
#include "host/reference/reflection.h"

namespace meniscal::reference {

// A point of a diffuse surface, seen from where a path comes.
struct DiffusePoint {
  DiffusePoint(const World& world, const Hit& hit, const shared::Surface& surface, const glm::dvec3& arrival);

  const Hit& hit;
  const shared::Surface& surface;
  glm::dvec3 side, shading;  // geometric and shading normal, towards where the path comes from
  bool glossy;               // it has an outer face that reflects
  Face face;
};

// How a path goes on from there.
struct Scattering {
  bool goes_on;
  bool by_lobe = false;
  double pdf = 0;     // by the lobe: of the direction, 1/sr
  double passed = 1;  // by Lambert's law: part of the light that the outer face lets through
};
enum class Lobes { both, gloss };  // that it may take
// Sends the path on: by `choice` and `place`, uniform in [0, 1) and in the unit square. `normal`: of Lambert's law.
Scattering scatter(const Tracer& tracer, Path& path, const DiffusePoint& point, const glm::dvec3& normal, Lobes lobes,
                   double choice, const glm::dvec2& place);
// The density with which that takes a direction by the lobe, 1/sr.
double scattering_pdf(const DiffusePoint& point, Lobes lobes, const glm::dvec3& direction);

}  // namespace meniscal::reference

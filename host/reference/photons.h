// One photon, from its target to its end: the specification of shaders/photons.comp. Paper, section 4.2.1.
#pragma once

#include "host/reference/path.h"
#include "host/render/backend.h"

namespace meniscal::reference {

struct Photon {
  std::uint32_t map;         // shared::MAP_*
  glm::dvec3 position;       // where it ended
  Footprint disc;            // of a stored one; alpha x beta points to the side of arrival
  glm::dvec3 arrival;        // the way it travelled there
  glm::dvec3 entered, flux;  // as it met its target, as it ended
  double let_through = 1;    // by a mirror's face above the surface it is stored on: see Path
  std::uint32_t end;         // triangle it was stored on, or shared::END_*
  glm::dvec3 absorbed{0};  // of what entered: by media, mirrors and coloured glass on the way, and by diffuse surfaces
  glm::dvec3 cut{0};       // by the limits on bounces

  Fate fate() const { return {mean_of(entered), mean_of(flux), mean_of(absorbed), mean_of(cut), end}; }
};

// `photon`: of the pass, among those of all beams; of the caustics' or of the global map.
Photon trace_photon(const Tracer& tracer, const RenderSettings& settings, std::uint32_t pass, std::uint32_t photon,
                    const Perturbation& perturbation = {}, bool global = false);

}  // namespace meniscal::reference

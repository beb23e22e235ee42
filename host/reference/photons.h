// One photon, from its target to its end: the specification of shaders/photons.comp. Paper, section 4.2.1.
#pragma once

#include "host/reference/path.h"
#include "host/render/settings.h"

namespace meniscal::reference {

struct Photon {
  glm::dvec3 position;       // where it ended
  Footprint disc;            // of a stored one; alpha x beta points to the side of arrival
  glm::dvec3 entered, flux;  // as it met its target, as it ended; of one of `started` photons of the stratum
  std::uint32_t end;         // triangle it was stored on, or shared::END_*
};

struct PhotonSettings {
  std::uint32_t seed = 0, pass = 0;
  std::uint32_t started = 1;  // in the stratum, in one pass
  std::uint32_t specular_bounces = 8;
  Discs discs;
};

Photon trace_photon(const Tracer& tracer, const Stratum& stratum, const PhotonSettings& settings, std::uint32_t index,
                    const Perturbation& perturbation = {});

}  // namespace meniscal::reference

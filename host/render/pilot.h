// A look ahead: which starts of photons the camera will see anything of.
#pragma once

#include "host/render/backend.h"
#include "host/render/budgets.h"

namespace meniscal {

struct Pilot {
  std::vector<StartSet> starts;
  std::uint32_t split;  // see RenderSettings
  MapNoise noise;       // none without interreflection
  // Photons of the global map in a disc, in the mean over what is seen, per those of photons spread evenly over the
  // scene (World::radius); 0: unknown. In steps, for devices that see one photon more.
  double crowding = 0;
};

// The same view in some thousand pixels.
RenderSettings coarse_view(RenderSettings settings);

// Traces some thousand camera rays and photons, more where hardly any photons land in so small a view, and gives
// windows round the starts of those photons that landed where the camera sees, with shares as the square roots of the
// flux that they brought there. Where nothing is seen, not even round it: default_starts. Where interreflection needs
// photons, too, looks twice at what either map gives: that is its noise, and counts how many photons discs hold.
// Deterministic. The backend has other settings afterwards.
Pilot look_ahead(Backend& backend, const World& world, const RenderSettings& settings);

}  // namespace meniscal

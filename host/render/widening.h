// How wide the discs of caustics' photons should be in a scene and view.
#pragma once

#include "host/render/backend.h"

namespace meniscal {

// Factor on the reach of make_beams, within [1, 2.8] and in quarters of an octave: where noise and blur of a pass of so
// many photons balance. Lights a coarse picture with a part of the photons, twice, by discs as wide as all of them
// would have by default and by discs twice as wide: what two passes differ by is noise, what both agree on that wider
// discs change is blur. Deterministic. The backend has other settings afterwards.
double find_widening(Backend& backend, const World& world, const RenderSettings& settings,
                     const std::vector<StartSet>& starts, std::uint32_t photons);

}  // namespace meniscal

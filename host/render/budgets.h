// How many photons the maps get in a pass.
#pragma once

#include <cstdint>

namespace meniscal {

struct Budgets {
  std::uint32_t caustics, global;  // of the targeted and the caustic map; of the global map
};

// Variance that one photon a pass would give the picture by either; n photons give an n-th of it.
struct MapNoise {
  double caustics = 0, global = 0;
};

// Shares the photons of both out anew, so that noise is least: by the square roots of variances. Neither gets more than
// the larger of both budgets, which memory is there for: what it cannot use is saved. Nor less than a sixteenth of all,
// since a pilot may overlook rare paths. A map without photons stays so.
Budgets share_photons(const Budgets& budgets, const MapNoise& noise);

}  // namespace meniscal

// The progressive loop: passes, one after the other, onto the film.
#pragma once

#include <functional>

#include "host/render/backend.h"
#include "host/render/film.h"

namespace meniscal {

struct PassRange {
  std::uint32_t first = 0, last = 0;  // first <= pass < last
};

// Renders the passes in order. `after_pass` hears how many are done; it returns false to stop there. Gives the sum of
// all passes' tallies.
Tallies render_passes(Backend& backend, const PassRange& passes, Film& film,
                      const std::function<bool(std::uint32_t)>& after_pass);

}  // namespace meniscal

// The progressive loop: passes, one after the other, onto the film.
#pragma once

#include <functional>

#include "host/render/backend.h"
#include "host/render/film.h"
#include "host/render/pass_ranges.h"

namespace meniscal {

// Renders the passes in order. `after_pass` hears how many are done; it returns false to stop there. Gives the sum of
// all passes' tallies.
Tallies render_passes(Backend& backend, const PassRange& passes, Film& film,
                      const std::function<bool(std::uint32_t)>& after_pass);

}  // namespace meniscal

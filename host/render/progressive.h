// The progressive loop: passes, one after the other, onto the film.
#pragma once

#include <functional>

#include "host/render/backend.h"
#include "host/render/film.h"
#include "host/render/pass_ranges.h"

namespace meniscal {

// Renders the passes in order. `after_pass` hears the sum of `tallies` and those of all passes so far; it returns false
// to stop there. Gives that sum.
Tallies render_passes(Backend& backend, const PassRange& passes, Film& film,
                      const std::function<bool(const Tallies&)>& after_pass, Tallies tallies = {});

}  // namespace meniscal

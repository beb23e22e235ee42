#include "host/render/progressive.h"

namespace meniscal {

Tallies render_passes(Backend& backend, const PassRange& passes, Film& film,
                      const std::function<bool(const Tallies&)>& after_pass, Tallies tallies) {
  for (std::uint32_t pass = passes.first; pass < passes.last; ++pass) {
    const Tallies ended =
        backend.render_pass(pass, [&](const auto& samples, const View& view) { film.add(samples, view); });
    film.end_pass(pass);
    for (std::size_t s = 0; s < tallies.size(); ++s) tallies[s].add(ended[s]);
    if (!after_pass(tallies)) break;
  }
  return tallies;
}

}  // namespace meniscal

// How the photons of a pass are shared out among the places where they may start.
#pragma once

#include <algorithm>

#include "host/world/world.h"

namespace meniscal {

// Part of the square of starts that gets photons of its own.
struct StartWindow {
  glm::dvec2 low{0}, high{1};
  double share = 0;  // of all photons
  bool seen = true;  // something of what starts outside the windows within is seen

  double part() const { return (high.x - low.x) * (high.y - low.y); }  // of the square
};

// All starts towards the targets from one distant light, or on one stratum's triangles from all lights without a view.
struct StartSet {
  std::optional<std::uint32_t> light;  // photons start in its view
  std::uint32_t stratum = 0;           // on whose triangles photons start
  std::vector<StartWindow> windows;    // each within the one before; the first is the whole square, so that whatever is
                                       // thought of a start it is never left out
};

constexpr std::size_t most_windows = 3;  // of a set
inline std::size_t most_beams(const World& world) {
  const auto views = std::count_if(world.views.begin(), world.views.end(), [](const auto& v) { return v.has_value(); });
  return most_windows * (std::size_t(views) + world.strata.size()) + 1;
}

// m2
double start_area(const World& world, const StartSet& set);

// Without knowledge of what is seen: the whole square, and in a light's view a window round the menisci. Shares: one
// half alike for all windows, one half as the square roots of their areas. Empty where no light could start photons.
std::vector<StartSet> default_starts(const World& world);

// `photons`: of a pass. Windows within others are widened by a border over which they fade in. `widening`: factor on
// the discs' usual reach.
std::vector<shared::Beam> make_beams(const World& world, const std::vector<StartSet>& starts, std::uint32_t photons,
                                     double widening = 1);

// Which of its beam's starts the i-th photon takes: its index in the Sobol sequence; see shared::Beam.
std::uint32_t start_index(const shared::Beam& beam, std::uint32_t i);

// All photons from the lights, by power: ordinary photon mapping. Its discs are round. Empty without lights.
std::vector<shared::Beam> light_beams(const World& world, std::uint32_t photons);

// Photons of the global map: from the lights towards what scatters at once, and towards the targets, as many; or all
// from the lights alone. Empty without lights.
std::vector<shared::Beam> global_beams(const World& world, std::uint32_t photons, bool from_lights);

}  // namespace meniscal

#include "host/passes/photons.h"

#include <bit>
#include <cmath>

namespace meniscal::passes {

PhotonBuffers::PhotonBuffers(const gpu::Device& device, std::size_t capacity, bool glossy, bool global)
    : map(global ? "global " : ""),
      ends(device, map + "photon ends", capacity * sizeof(shared::PhotonEnd)),
      discs(device, map + "photon discs", capacity * sizeof(shared::PhotonDisc)),
      arrivals(device, map + "photon arrivals", (glossy ? capacity : 0) * sizeof(std::uint32_t)) {}

namespace {

// Of one level: about as many as photons.
std::uint32_t level_cells(std::uint32_t photons) { return photons <= 1u << 16 ? 1u << 14 : 1u << 17; }

}  // namespace

Grid make_grid(std::uint32_t photons, const Discs& discs) {
  const double ratio = discs.widest / discs.narrowest;
  const auto levels =
      static_cast<std::uint32_t>(std::clamp(std::ceil(std::log2(ratio) - 1e-6), 0.0, shared::GRID_LEVELS - 1.0)) + 1;
  const std::uint32_t cells = level_cells(photons);
  const auto bits = static_cast<std::uint32_t>(std::bit_width(levels * cells - 1));
  return {discs, levels, cells - 1, (bits + shared::SORT_BITS - 1) / shared::SORT_BITS};
}

std::size_t most_cells(std::uint32_t photons) { return std::size_t(shared::GRID_LEVELS) * level_cells(photons); }

}  // namespace meniscal::passes

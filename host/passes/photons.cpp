#include "host/passes/photons.h"

#include <cmath>

namespace meniscal::passes {

PhotonBuffers::PhotonBuffers(const gpu::Device& device, std::size_t capacity)
    : ends(device, "photon ends", capacity * sizeof(shared::PhotonEnd)),
      discs(device, "photon discs", capacity * sizeof(shared::PhotonDisc)),
      keys(device, "photon cells", capacity * sizeof(std::uint32_t)) {}

Grid make_grid(std::uint32_t photons, const Discs& discs) {
  const double ratio = discs.widest / discs.narrowest;
  const auto levels =
      static_cast<std::uint32_t>(std::clamp(std::ceil(std::log2(ratio) - 1e-6), 0.0, shared::GRID_LEVELS - 1.0)) + 1;
  // About as many cells as photons; three digits hold 2^17 keys and that of what is not stored, four 2^23.
  const std::uint32_t cells = photons <= (1u << 16) ? 1u << 14 : 1u << (levels > 1 ? 17 : 20);
  return {discs, levels, cells - 1, std::size_t(levels) * cells <= (1u << 17) ? 3u : 4u};
}

}  // namespace meniscal::passes

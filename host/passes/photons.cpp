#include "host/passes/photons.h"

#include <cmath>

#include "shaders/shaders.h"
#include "shaders/shared/bindings.h"

namespace meniscal::passes {
namespace {

gpu::ComputePass make_pass(const gpu::Device& device, const SceneTables& tables, const RenderSettings& settings) {
  std::vector<gpu::Binding> layout = tables.layout();
  for (std::uint32_t i = 0; i < 4; ++i) layout.push_back({BIND_OUTPUT + i, gpu::Kind::storage});
  return {device,
          "photons",
          shader("photons", tables.texel),
          layout,
          sizeof(shared::PhotonPush),
          tables.constants(!settings.discs.round(), settings.integrator == Integrator::ordinary)};
}

gpu::BindingSet bind(const gpu::ComputePass& pass, const SceneTables& tables, const PhotonBuffers& b,
                     const gpu::Buffer& beams) {
  std::vector<gpu::Bound> bound = tables.bound();
  std::uint32_t binding = BIND_OUTPUT;
  for (const gpu::Buffer* buffer : {&b.ends, &b.discs, &b.keys, &beams}) bound.push_back({binding++, *buffer});
  return pass.bind(bound);
}

}  // namespace

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

PhotonPass::PhotonPass(const gpu::Device& device, const SceneTables& tables, const PhotonBuffers& buffers,
                       std::size_t beams, const RenderSettings& settings)
    : beams_(device, "beams", beams * sizeof(shared::Beam)),
      pass_(make_pass(device, tables, settings)),
      buffers_(bind(pass_, tables, buffers, beams_)) {}

void PhotonPass::run(gpu::Commands& commands, const World& world, const RenderSettings& settings, std::uint32_t pass,
                     std::uint32_t first_photon, std::uint32_t photons, const Grid& grid) {
  beams_.upload(settings.beams);
  shared::PhotonPush push{};
  push.seed = settings.seed;
  push.pass = pass;
  push.beams = static_cast<std::uint32_t>(settings.beams.size());
  push.light_count = static_cast<std::uint32_t>(world.lights.size());
  push.buffer_first = first_photon;
  push.specular_bounces = settings.specular_bounces;
  push.shrink = static_cast<float>(grid.discs.shrink);
  push.narrowest = static_cast<float>(grid.discs.narrowest);
  push.widest = static_cast<float>(grid.discs.widest);
  push.cell_mask = grid.mask;
  batch_.run(commands, photons, [&](std::uint32_t first, std::uint32_t count) {
    push.first = first_photon + first;
    push.count = count;
    commands.dispatch(pass_, buffers_, push, groups_of_64(count));
  });
}

}  // namespace meniscal::passes

#include "host/passes/photons.h"

#include "shaders/shaders.h"
#include "shaders/shared/bindings.h"

namespace meniscal::passes {
namespace {

gpu::ComputePass make_pass(const gpu::Device& device, const SceneTables& tables) {
  std::vector<gpu::Binding> layout = tables.layout();
  for (std::uint32_t i = 0; i < 4; ++i) layout.push_back({BIND_OUTPUT + i, gpu::Kind::storage});
  return {device, "photons", shader("photons", tables.texel), layout, sizeof(shared::PhotonPush), tables.constants};
}

gpu::BindingSet bind(const gpu::ComputePass& pass, const SceneTables& tables, const PhotonBuffers& b) {
  std::vector<gpu::Bound> bound = tables.bound();
  std::uint32_t binding = BIND_OUTPUT;
  for (const gpu::Buffer* buffer : {&b.places, &b.powers, &b.keys, &b.entered}) bound.push_back({binding++, *buffer});
  return pass.bind(bound);
}

}  // namespace

PhotonBuffers::PhotonBuffers(const gpu::Device& device, std::size_t capacity)
    : places(device, "photon places", capacity * sizeof(shared::PhotonPlace)),
      powers(device, "photon powers", capacity * sizeof(shared::PhotonPower)),
      keys(device, "photon cells", capacity * sizeof(std::uint32_t)),
      entered(device, "photon flux at the target", capacity * sizeof(float)) {}

Grid make_grid(std::uint32_t photons, double radius) {
  // Key digits of 7 bits hold 2^13 or 2^20 cells and the key of what is not stored.
  const std::uint32_t cells = photons <= (1u << 14) ? 1u << 13 : 1u << 20;
  return {cells - 1, static_cast<float>(2.0001 * radius)};
}

PhotonPass::PhotonPass(const gpu::Device& device, const SceneTables& tables, const PhotonBuffers& buffers)
    : pass_(make_pass(device, tables)), buffers_(bind(pass_, tables, buffers)) {}

void PhotonPass::run(gpu::Commands& commands, const World& world, const RenderSettings& settings, std::size_t stratum,
                     std::uint32_t pass, const Grid& grid) {
  const Stratum& s = world.strata[stratum];
  const std::uint32_t photons = settings.photons[stratum];
  shared::PhotonPush push{};
  push.seed = settings.seed;
  push.pass = pass;
  push.stream = s.stream;
  push.target_first = s.first;
  push.target_count = s.count;
  push.light_first = world.light_first;
  push.light_count = static_cast<std::uint32_t>(world.lights.size());
  push.power_scale = static_cast<float>(s.area / photons);
  push.cell_size = grid.cell_size;
  push.cell_mask = grid.mask;
  push.specular_bounces = settings.specular_bounces;
  batch_.run(commands, photons, [&](std::uint32_t first, std::uint32_t count) {
    push.first = first;
    push.count = count;
    commands.dispatch(pass_, buffers_, push, groups_of_64(count));
  });
}

}  // namespace meniscal::passes

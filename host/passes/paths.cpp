#include "host/passes/paths.h"

#include <algorithm>

#include "host/passes/camera_view.h"
#include "host/world/media.h"
#include "shaders/shaders.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/material.h"
#include "shaders/shared/random.h"

namespace meniscal::passes {
namespace {

gpu::ComputePass make_pass(const gpu::Device& device, const SceneTables& tables, const World& world,
                           const RenderSettings& settings) {
  std::vector<gpu::Binding> layout = tables.layout();
  for (std::uint32_t binding : {BIND_ENDS, BIND_DISCS, BIND_SAMPLES, BIND_ARRIVALS, BIND_GLOSS})
    layout.push_back({binding, gpu::Kind::storage});
  for (std::uint32_t binding : {BIND_BEAMS, BIND_VIEW})
    layout.push_back({binding, tables.texel ? gpu::Kind::texel : gpu::Kind::storage});
  return {
      device,
      "paths",
      shader("paths", tables.texel),
      layout,
      sizeof(shared::PathPush),
      tables.constants({.differentials = carries_differentials(settings),
                        .emission = !world.lights.empty() &&
                                    (settings.integrator == Integrator::ordinary || settings.diffuse_bounces > 0),
                        .scattering = settings.diffuse_bounces > 0,
                        .nested = !why_nested(world, settings.camera_media).empty(),
                        .gloss = world.glossy,
                        .rough = std::any_of(world.surfaces.begin(), world.surfaces.end(), shared::is_rough_specular),
                        .highlights = settings.highlights})};
}

shared::PathPush make_push(const World& world, const RenderSettings& settings, std::uint32_t kind, std::uint32_t pass) {
  shared::PathPush push{};
  push.kind = kind;
  push.seed = settings.seed;
  push.pass = pass;
  push.specular_bounces = settings.specular_bounces;
  push.light_count = static_cast<std::uint32_t>(world.lights.size());
  push.light_first = world.light_first;
  return push;
}

}  // namespace

PathsPass::PathsPass(const gpu::Device& device, const World& world, const SceneTables& tables,
                     const PhotonBuffers& caustics, const PhotonBuffers* global, const std::vector<PixelTile>& tiles,
                     const RenderSettings& settings)
    : world_(world),
      tiles_(tiles),
      beams_(device, "beams", (caustics.ends.bytes() > 0 ? most_beams(world) : 0) * sizeof(shared::Beam)),
      global_beams_(device, "global beams", (global ? most_beams(world) : 0) * sizeof(shared::Beam)),
      view_(device, "camera", sizeof(shared::CameraView)),
      pass_(make_pass(device, tables, world, settings)) {
  const auto bind = [&](const PhotonBuffers& photons, const gpu::Buffer& beams, const PixelTile& tile) {
    std::vector<gpu::Bound> bound = tables.bound();
    bound.push_back({BIND_ENDS, photons.ends});
    bound.push_back({BIND_DISCS, photons.discs});
    bound.push_back({BIND_SAMPLES, tile.samples});
    bound.push_back({BIND_ARRIVALS, photons.arrivals});
    bound.push_back({BIND_GLOSS, tile.gloss});
    bound.push_back({BIND_BEAMS, beams, gpu::Format::rgba32ui});
    bound.push_back({BIND_VIEW, view_, gpu::Format::rgba32ui});
    return pass_.bind(bound);
  };
  for (const PixelTile& tile : tiles) buffers_.push_back(bind(caustics, beams_, tile));
  if (global) global_buffers_ = bind(*global, global_beams_, tiles.front());
}

void PathsPass::trace_photons(gpu::Commands& commands, const RenderSettings& settings, bool global, std::uint32_t pass,
                              std::uint32_t first_photon, std::uint32_t photons, const Grid& grid) {
  const PhotonSet& set = global ? settings.global : settings.caustics;
  const std::string photons_of = global ? "global " : "";
  (global ? global_beams_ : beams_).upload(set.beams);
  shared::PathPush push = make_push(world_, settings, shared::PATHS_PHOTON, pass);
  push.beams = static_cast<std::uint32_t>(set.beams.size());
  push.stream = global ? shared::STREAM_GLOBAL : shared::STREAM_BEAM;
  push.scatterings = set.scatterings;
  push.keeps_caustics = set.keeps_caustics ? 1 : 0;
  push.keeps_specular = settings.integrator == Integrator::ordinary ? 1 : 0;
  push.buffer_first = first_photon;
  push.shrink = static_cast<float>(grid.discs.shrink);
  push.narrowest = static_cast<float>(grid.discs.narrowest);
  push.widest = static_cast<float>(grid.discs.widest);
  photon_batch_.run(commands, photons, [&](std::uint32_t first, std::uint32_t count) {
    push.first = first_photon + first;
    push.count = count;
    commands.dispatch(pass_, global ? *global_buffers_ : buffers_.front(), push, groups_of_64(count),
                      photons_of + "photons");
  });
}

void PathsPass::trace_camera(gpu::Commands& commands, const RenderSettings& settings, std::uint32_t pass,
                             const View& view) {
  view_.upload(std::vector{camera_view(settings, pass)});
  shared::PathPush push = make_push(world_, settings, shared::PATHS_CAMERA, pass);
  push.sample_index = view.sample;
  push.branch = view.branch;
  push.bounced = view.bounced ? 1 : 0;
  push.gloss_only = settings.final_gathering ? 0 : 1;
  push.bounces_gloss = settings.bounces_gloss ? 1 : 0;
  push.keeps = keeps_irradiance(settings, view) ? 1 : 0;
  for (std::size_t t = 0; t < tiles_.size() && tiles_[t].first < settings.crop.pixels(); ++t) {
    push.buffer_first = tiles_[t].first;
    const auto pixels = static_cast<std::uint32_t>(settings.crop.pixels() - tiles_[t].first);
    camera_batch_.run(commands, std::min(tiles_[t].count, pixels), [&](std::uint32_t first, std::uint32_t count) {
      push.first = tiles_[t].first + first;
      push.count = count;
      commands.dispatch(pass_, buffers_[t], push, groups_of_64(count), "camera");
    });
  }
}

}  // namespace meniscal::passes

// Photons and camera paths, traced to their ends: host side of shaders/paths.comp.
#pragma once

#include <optional>

#include "host/passes/batch.h"
#include "host/passes/photons.h"
#include "host/passes/pixels.h"
#include "host/passes/scene_tables.h"
#include "host/render/backend.h"

namespace meniscal::passes {

class PathsPass {
 public:
  // Writes photons to `caustics` and `global` (null: no global map), samples to the tiles; these must outlive the pass.
  // Of the settings, the integrator, the diffuse bounces and whether discs are round stay; there will be most_beams of
  // each at the most.
  PathsPass(const gpu::Device& device, const World& world, const SceneTables& tables, const PhotonBuffers& caustics,
            const PhotonBuffers* global, const std::vector<PixelTile>& tiles, const RenderSettings& settings);

  // Photons first .. first + count of a pass, of the caustics or of the global map, into their buffers from the
  // beginning on.
  void trace_photons(gpu::Commands& commands, const RenderSettings& settings, bool global, std::uint32_t pass,
                     std::uint32_t first, std::uint32_t count, const Grid& grid);
  // One path for each pixel of the crop, into the tiles from their beginning on; what keeps_irradiance finds that
  // of the sample before there.
  void trace_camera(gpu::Commands& commands, const RenderSettings& settings, std::uint32_t pass, const View& view);

 private:
  const World& world_;
  const std::vector<PixelTile>& tiles_;
  gpu::Buffer beams_, global_beams_, view_;
  gpu::ComputePass pass_;
  std::vector<gpu::BindingSet> buffers_;  // by tile, with the caustics' photons
  std::optional<gpu::BindingSet> global_buffers_;
  Batch photon_batch_, camera_batch_;
};

}  // namespace meniscal::passes

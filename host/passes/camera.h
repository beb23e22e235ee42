// Camera paths to the first diffuse surface, with direct light: host side of shaders/camera.comp.
#pragma once

#include "host/passes/batch.h"
#include "host/passes/pixels.h"
#include "host/passes/scene_tables.h"
#include "host/render/settings.h"

namespace meniscal::passes {

class CameraPass {
 public:
  // `tiles` must outlive the pass, which writes their samples.
  // `differentials`: samples lie where pixels' centres see; else where their rays end.
  CameraPass(const gpu::Device& device, const SceneTables& tables, const std::vector<PixelTile>& tiles,
             bool differentials);
  void run(gpu::Commands& commands, const World& world, const RenderSettings& settings, std::uint32_t pass);

 private:
  gpu::ComputePass pass_;
  const std::vector<PixelTile>& tiles_;
  std::vector<gpu::BindingSet> buffers_;  // by tile
  Batch batch_;
};

}  // namespace meniscal::passes

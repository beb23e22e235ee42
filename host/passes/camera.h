// Camera paths to the first diffuse surface, with direct light: host side of shaders/camera.comp.
#pragma once

#include "host/passes/batch.h"
#include "host/passes/scene_tables.h"
#include "host/render/settings.h"

namespace meniscal::passes {

class CameraPass {
 public:
  // Writes PixelSample[crop pixels] into `samples`.
  CameraPass(const gpu::Device& device, const SceneTables& tables, const gpu::Buffer& samples);
  void run(gpu::Commands& commands, const World& world, const RenderSettings& settings, std::uint32_t pass);

 private:
  gpu::ComputePass pass_;
  gpu::BindingSet buffers_;
  Batch batch_;
};

}  // namespace meniscal::passes

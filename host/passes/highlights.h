// Highlights, the lights that pixels see in menisci: host side of shaders/highlights.comp.
#pragma once

#include "host/passes/batch.h"
#include "host/passes/scene_tables.h"
#include "host/render/settings.h"

namespace meniscal::passes {

class HighlightsPass {
 public:
  // Of the settings, the highlights stay.
  HighlightsPass(const gpu::Device& device, const World& world, SceneTables& tables, const RenderSettings& settings);

  // Mean radiances in a pass, by pixel of the crop; 0 of those that are not listed.
  std::vector<glm::vec3> run(gpu::Commands& commands, const RenderSettings& settings, std::uint32_t pass,
                             const std::vector<std::uint32_t>& pixels);

 private:
  SceneTables& tables_;
  std::uint32_t capacity_;  // pixels at once
  std::uint32_t lights_;
  gpu::Buffer listed_, highlights_, view_;
  gpu::ComputePass pass_;
  gpu::BindingSet buffers_;
  Batch batch_;
};

}  // namespace meniscal::passes

#include "host/passes/camera.h"

#include "shaders/shaders.h"
#include "shaders/shared/bindings.h"

namespace meniscal::passes {
namespace {

gpu::ComputePass make_pass(const gpu::Device& device, const SceneTables& tables, bool differentials) {
  std::vector<gpu::Binding> layout = tables.layout();
  layout.push_back({BIND_OUTPUT, gpu::Kind::storage});
  return {device,
          "camera",
          shader("camera", tables.texel),
          layout,
          sizeof(shared::CameraPush),
          tables.constants(differentials, false)};
}

gpu::BindingSet bind(const gpu::ComputePass& pass, const SceneTables& tables, const gpu::Buffer& samples) {
  std::vector<gpu::Bound> bound = tables.bound();
  bound.push_back({BIND_OUTPUT, samples});
  return pass.bind(bound);
}

}  // namespace

CameraPass::CameraPass(const gpu::Device& device, const SceneTables& tables, const std::vector<PixelTile>& tiles,
                       bool differentials)
    : pass_(make_pass(device, tables, differentials)), tiles_(tiles) {
  for (const PixelTile& tile : tiles) buffers_.push_back(bind(pass_, tables, tile.samples));
}

void CameraPass::run(gpu::Commands& commands, const World& world, const RenderSettings& settings, std::uint32_t pass) {
  const CameraAxes axes = camera_axes(settings.camera, settings.width, settings.height);
  shared::CameraPush push{};
  push.right = glm::vec4(axes.right, 0);
  push.up = glm::vec4(axes.up, 0);
  push.forward = glm::vec4(axes.forward, 0);
  push.origin = glm::vec4(axes.origin, settings.camera.orthographic ? 1 : 0);
  push.seed = settings.seed;
  push.pass = pass;
  push.width = settings.width;
  push.height = settings.height;
  push.crop_x = settings.crop.x0;
  push.crop_y = settings.crop.y0;
  push.crop_width = settings.crop.width();
  push.light_first = world.light_first;
  push.light_count = static_cast<std::uint32_t>(world.lights.size());
  push.specular_bounces = settings.specular_bounces;
  push.jitter = pixel_jitter(settings, pass);
  push.most_shift = static_cast<float>(most_shift(settings));
  for (std::size_t t = 0; t < tiles_.size(); ++t) {
    push.buffer_first = tiles_[t].first;
    if (tiles_[t].first >= settings.crop.pixels()) break;
    const auto pixels = static_cast<std::uint32_t>(settings.crop.pixels() - tiles_[t].first);
    batch_.run(commands, std::min(tiles_[t].count, pixels), [&](std::uint32_t first, std::uint32_t count) {
      push.first = tiles_[t].first + first;
      push.count = count;
      commands.dispatch(pass_, buffers_[t], push, groups_of_64(count));
    });
  }
}

}  // namespace meniscal::passes

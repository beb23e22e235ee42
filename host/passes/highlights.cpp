#include "host/passes/highlights.h"

#include <algorithm>

#include "host/passes/camera_view.h"
#include "host/passes/pixels.h"
#include "host/world/media.h"
#include "shaders/shaders.h"
#include "shaders/shared/bindings.h"

namespace meniscal::passes {
namespace {

gpu::ComputePass make_pass(const gpu::Device& device, const SceneTables& tables, const World& world,
                           const RenderSettings& settings) {
  std::vector<gpu::Binding> layout = tables.layout();
  for (std::uint32_t binding : {BIND_LISTED, BIND_HIGHLIGHTS}) layout.push_back({binding, gpu::Kind::storage});
  layout.push_back({BIND_VIEW, tables.texel ? gpu::Kind::texel : gpu::Kind::storage});
  return {device,
          "highlights",
          shader("highlights", tables.texel),
          layout,
          sizeof(shared::HighlightPush),
          tables.constants({.differentials = true,
                            .nested = !why_nested(world, settings.camera_media).empty(),
                            .highlights = settings.highlights})};
}

}  // namespace

HighlightsPass::HighlightsPass(const gpu::Device& device, const World& world, SceneTables& tables,
                               const RenderSettings& settings)
    : tables_(tables),
      capacity_(static_cast<std::uint32_t>(std::min(settings.crop.pixels(), most_tile_pixels))),
      lights_(static_cast<std::uint32_t>(world.lights.size())),
      listed_(device, "highlight pixels", capacity_ * sizeof(std::uint32_t)),
      highlights_(device, "highlights", capacity_ * sizeof(glm::vec4)),
      view_(device, "highlight camera", sizeof(shared::CameraView)),
      pass_(make_pass(device, tables, world, settings)),
      buffers_(pass_.bind([&] {
        std::vector<gpu::Bound> bound = tables.bound();
        bound.push_back({BIND_LISTED, listed_});
        bound.push_back({BIND_HIGHLIGHTS, highlights_});
        bound.push_back({BIND_VIEW, view_, gpu::Format::rgba32ui});
        return bound;
      }())) {}

std::vector<glm::vec3> HighlightsPass::run(gpu::Commands& commands, const RenderSettings& settings, std::uint32_t pass,
                                           const std::vector<std::uint32_t>& pixels) {
  view_.upload(std::vector{camera_view(settings, pass)});
  shared::HighlightPush push{};
  push.seed = settings.seed;
  push.pass = pass;
  push.cells = settings.highlight_cells;
  push.light_count = lights_;
  push.specular_bounces = settings.specular_bounces;
  std::vector<glm::vec3> all(settings.crop.pixels());
  for (std::size_t done = 0; done < pixels.size();) {
    const std::size_t count = std::min<std::size_t>(pixels.size() - done, capacity_);
    const std::vector<std::uint32_t> part(pixels.begin() + static_cast<std::ptrdiff_t>(done),
                                          pixels.begin() + static_cast<std::ptrdiff_t>(done + count));
    listed_.upload(part);
    for (push.first_cell = 0; push.first_cell < push.cells * push.cells; push.first_cell += shared::HIGHLIGHT_ROUND) {
      batch_.run(commands, static_cast<std::uint32_t>(count), [&](std::uint32_t first, std::uint32_t now) {
        push.first = first;
        push.count = now;
        commands.dispatch(pass_, buffers_, push, groups_of_64(now));
      });
      tables_.collect_counters();
    }
    const auto found = highlights_.download<glm::vec4>(0, count);
    for (std::size_t i = 0; i < count; ++i) all[part[i]] = glm::vec3(found[i]);
    done += count;
  }
  return all;
}

}  // namespace meniscal::passes

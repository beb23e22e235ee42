#include "host/cli/start_backend.h"

#include "host/cli/render_settings.h"
#include "host/error.h"
#include "host/passes/fetch_probe.h"
#include "host/reference/backend.h"
#include "host/render/gpu_backend.h"

namespace meniscal {
namespace {

std::unique_ptr<Backend> make_backend(const std::string& device, const World& world, const RenderSettings& settings) {
  if (settings.integrator == Integrator::path && device != "cpu")
    throw Error(ExitCode::usage, "--integrator path: the reference path alone traces paths; add --device cpu");
  if (device == "cpu") return std::make_unique<reference::ReferenceBackend>(world, settings);
  gpu::Device opened = gpu::Device::open(device);
  passes::choose_by_measurement(opened);
  return std::make_unique<GpuBackend>(std::move(opened), world, settings);
}

}  // namespace

std::unique_ptr<Backend> start_backend(const RenderOptions& options, const World& world, RenderSettings& settings,
                                       Stages& stages) {
  std::unique_ptr<Backend> backend = make_backend(options.device, world, settings);
  const Stopwatch watch;
  if (focus(settings, options, world, *backend)) stages.add("pilot", watch.seconds());
  return backend;
}

}  // namespace meniscal

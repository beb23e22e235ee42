// The Vulkan passes as a backend.
#pragma once

#include <memory>

#include "host/gpu/device.h"
#include "host/render/backend.h"

namespace meniscal {

class GpuBackend final : public Backend {
 public:
  // `world` must outlive the backend. Without `allow_texel` tables are read through storage buffers even where texel
  // buffers would do. Throws Error(ExitCode::device) when the device cannot hold or run it.
  GpuBackend(gpu::Device device, const World& world, RenderSettings settings, bool allow_texel = true);
  ~GpuBackend() override;

  Tallies render_pass(std::uint32_t pass, const TakeSamples& take) override;
  std::vector<PhotonEnd> trace_photons(std::uint32_t pass) override;
  std::vector<shared::PixelSample> trace_camera(std::uint32_t pass, const View& view) override;
  Samples light_camera(std::uint32_t pass, const View& view, std::uint32_t photon_pass) override;
  void configure(const RenderSettings& settings) override;
  Statistics statistics() const override;

 private:
  struct Passes;
  std::unique_ptr<Passes> passes_;
};

}  // namespace meniscal

// The reference path as a backend: serial, double precision, naive.
#pragma once

#include "host/reference/density.h"
#include "host/render/backend.h"

namespace meniscal::reference {

class ReferenceBackend final : public Backend {
 public:
  ReferenceBackend(const World& world, RenderSettings settings)
      : world_(world), settings_(std::move(settings)), tracer_(world) {}

  Tallies render_pass(std::uint32_t pass, const TakeSamples& take) override;
  std::vector<PhotonEnd> trace_photons(std::uint32_t pass) override;
  std::vector<shared::PixelSample> trace_camera(std::uint32_t pass, const View& view) override;
  Samples light_camera(std::uint32_t pass, const View& view, std::uint32_t photon_pass) override;
  void configure(const RenderSettings& settings) override { settings_ = settings; }
  Statistics statistics() const override;

 private:
  std::vector<Photon> photons(std::uint32_t pass, bool global);
  Samples trace_paths(std::uint32_t pass, const View& view);
  std::vector<glm::vec3> trace_highlights(std::uint32_t pass, const std::vector<std::uint32_t>& pixels) const;
  PhotonMap make_map(const std::vector<Photon>& photons, const PhotonSet& set, std::uint32_t pass) const;
  // Adds the maps' light to a sample; `gloss`: none where no outer face reflects.
  void light(shared::PixelSample& sample, shared::PixelGloss* gloss, const View& view, const PhotonMap& caustics,
             const PhotonMap& global) const;

  const World& world_;
  RenderSettings settings_;
  Tracer tracer_;
  Stages stages_;
};

}  // namespace meniscal::reference

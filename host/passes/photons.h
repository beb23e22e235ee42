// Photons of one stratum, traced to their ends: host side of shaders/photons.comp.
#pragma once

#include "host/passes/batch.h"
#include "host/passes/scene_tables.h"
#include "host/render/settings.h"

namespace meniscal::passes {

// One slot a started photon.
struct PhotonBuffers {
  gpu::Buffer places, powers, keys, entered;
  PhotonBuffers(const gpu::Device& device, std::size_t capacity);
};

// Cells of the hash grid for a map of this many photons: (mask, side).
struct Grid {
  std::uint32_t mask;
  float cell_size;
};
Grid make_grid(std::uint32_t photons, double radius);

class PhotonPass {
 public:
  PhotonPass(const gpu::Device& device, const SceneTables& tables, const PhotonBuffers& buffers);
  void run(gpu::Commands& commands, const World& world, const RenderSettings& settings, std::size_t stratum,
           std::uint32_t pass, const Grid& grid);

 private:
  gpu::ComputePass pass_;
  gpu::BindingSet buffers_;
  Batch batch_;
};

}  // namespace meniscal::passes

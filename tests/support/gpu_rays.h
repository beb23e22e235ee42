// Closest hits of given rays by the shaders' traversal.
#pragma once

#include "host/passes/batch.h"
#include "host/passes/scene_tables.h"
#include "rays_spirv.h"
#include "shaders/shared/bindings.h"

namespace meniscal::test {

constexpr std::uint32_t no_triangle = 0xFFFFFFFFu;

struct Ray {  // as rays.comp reads it
  glm::vec3 origin;
  std::uint32_t skip;
  glm::vec3 direction;
  float reach;
};
struct Hit {
  float t;
  std::uint32_t triangle;
  float u, v;
};

class GpuRays {
 public:
  GpuRays(const gpu::Device& device, const World& world, const std::vector<Ray>& rays)
      : tables_(device, world, 0, true),
        rays_(device, "rays", rays.size() * sizeof(Ray)),
        hits_(device, "hits", rays.size() * sizeof(Hit)),
        pass_(device, "rays", rays_spirv, layout(), 4, tables_.constants({})),
        bound_(pass_.bind(bindings())),
        commands_(device),
        count_(static_cast<std::uint32_t>(rays.size())) {
    rays_.upload(rays);
  }
  void intersect() {
    commands_.dispatch(pass_, bound_, count_, passes::groups_of_64(count_));
    commands_.submit_and_wait();
  }
  std::vector<Hit> hits() const { return hits_.download<Hit>(); }

 private:
  std::vector<gpu::Binding> layout() const {
    auto layout = tables_.layout();
    layout.push_back({BIND_OUTPUT, gpu::Kind::storage});
    layout.push_back({BIND_OUTPUT + 1, gpu::Kind::storage});
    return layout;
  }
  std::vector<gpu::Bound> bindings() const {
    auto bound = tables_.bound();
    bound.push_back({BIND_OUTPUT, rays_});
    bound.push_back({BIND_OUTPUT + 1, hits_});
    return bound;
  }
  passes::SceneTables tables_;
  gpu::Buffer rays_, hits_;
  gpu::ComputePass pass_;
  gpu::BindingSet bound_;
  gpu::Commands commands_;
  std::uint32_t count_;
};

}  // namespace meniscal::test

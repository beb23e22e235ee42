// Scenes, worlds and backends as the program makes them, for tests.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "host/cli/render_settings.h"
#include "host/reference/backend.h"
#include "host/render/gpu_backend.h"
#include "host/render/progressive.h"
#include "tests/gpu/device_fixture.h"

namespace meniscal::test {

struct Setup {
  Scene scene;
  World world;
  RenderSettings settings;
};

// `name`: of scenes/NAME.gltf. `edit` changes the scene before its menisci are built.
inline std::unique_ptr<Setup> make_setup(const std::string& name, const RenderOptions& options,
                                         const std::function<void(Scene&)>& edit = {}) {
  Scene scene = load_gltf(std::string(SCENES) + "/" + name + ".gltf");
  if (edit) edit(scene);
  World world = build_world(scene, options.meniscus);
  RenderSettings settings = choose_settings(options, scene, world);
  return std::make_unique<Setup>(Setup{std::move(scene), std::move(world), std::move(settings)});
}

inline std::unique_ptr<Backend> make_backend(bool on_gpu, const World& world, const RenderSettings& settings) {
  if (on_gpu) return std::make_unique<GpuBackend>(gpu::Device::open("auto"), world, settings);
  return std::make_unique<reference::ReferenceBackend>(world, settings);
}

inline RenderOptions small_options(std::uint32_t photons, int width = 64, int height = 64) {
  RenderOptions options;
  options.meniscus = MeniscusModel::paper;
  options.photons = photons;
  options.resolution = Resolution{width, height};
  options.specular_bounces = 8;
  options.diffuse_bounces = 0;
  options.samples = 1;
  return options;
}

// The samples of all views, one after the other.
struct PassResult {
  std::vector<shared::PixelSample> samples;
  std::vector<shared::PixelGloss> gloss;  // none where no outer face reflects
  Tallies tallies;
};
inline PassResult render_pass(Backend& backend, std::uint32_t pass) {
  PassResult result;
  result.tallies = backend.render_pass(pass, [&](const Samples& samples, const View&) {
    result.samples.insert(result.samples.end(), samples.pixels.begin(), samples.pixels.end());
    result.gloss.insert(result.gloss.end(), samples.gloss.begin(), samples.gloss.end());
  });
  return result;
}

// Of a sample, in all.
inline glm::dvec3 radiance(const PassResult& result, std::size_t i) {
  const shared::PixelSample& s = result.samples[i];
  const shared::PixelGloss g = result.gloss.empty() ? shared::PixelGloss{} : result.gloss[i];
  return glm::dvec3(s.emitted) + glm::dvec3(s.weight) * glm::dvec3(s.direct + s.targeted + s.caustic + s.global) +
         glm::dvec3(g.direct + g.targeted + g.caustic + g.global);
}

inline const Stratum* find_stratum(const World& world, const std::string& name) {
  for (const Stratum& s : world.strata)
    if (s.name == name) return &s;
  return nullptr;
}

}  // namespace meniscal::test

// The world's tables on the GPU: shaders/scene.glsl reads them in every pass that traces rays.
#pragma once

#include "host/gpu/commands.h"
#include "host/passes/texture_tables.h"
#include "host/world/world.h"

namespace meniscal::passes {

// What paths do, beside what the scene has.
struct PathFeatures {
  bool differentials = false;                          // they carry them
  bool emission = false;                               // photons start on the lights
  bool scattering = false;                             // they go on from diffuse surfaces
  bool nested = false;                                 // they keep count of the dielectrics that they are inside of
  bool gloss = false;                                  // outer faces above diffuse surfaces reflect
  bool rough = false;                                  // specular surfaces are rough
  std::uint32_t highlights = shared::HIGHLIGHTS_NONE;  // that another pass has
};

struct SceneTables {
  TextureTables textures;
  gpu::Buffer scene, normals, surfaces, lights, cdf, targets, environment, counters;
  // Specialisation constants of scene.glsl in order of their ids, without those of PathFeatures; the latter stand
  // between the two, and the textures' and the next one come last.
  std::vector<std::uint32_t> scene_constants, sky_constants;
  bool has_directional;
  bool texel;  // tables are read through texel buffers: how shaders are to be compiled

  // Texel buffers are used where `allow_texel`, and where the largest table fits: `largest_table` is the number of
  // 16-byte elements of the largest that shaders will read beside these.
  SceneTables(const gpu::Device& device, const World& world, std::size_t largest_table, bool allow_texel);

  // Adds the GPU's 32-bit counters to `sums` and clears them: once a pass, before they run over.
  void collect_counters();
  std::array<std::uint64_t, shared::COUNTERS> sums{};  // by shared::COUNTER_*

  std::vector<std::uint32_t> constants(const PathFeatures& features) const;
  std::vector<gpu::Binding> layout() const;  // of the bindings that all passes have that trace rays
  std::vector<gpu::Bound> bound() const;
};

}  // namespace meniscal::passes

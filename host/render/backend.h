// Who computes a pass: the GPU or the reference path. Both answer alike, photon by photon.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "host/gpu/record.h"
#include "host/render/settings.h"
#include "host/stages.h"
#include "shaders/shared/branches.h"

namespace meniscal {

// What became of one photon: its flux as it met its target and as it ended, what of it was absorbed, and what the
// limits on bounces cut. Means over the colour channels.
struct Fate {
  double entered, flux, absorbed, cut;
  std::uint32_t end;  // triangle, or shared::END_*
};

// How the photons of one map ended in one or more passes. Of the targeted and the caustic map's light
//   flux_in = flux_escaped + flux_cut + flux_absorbed + the sum of flux_landed,
// photon by photon. Of the global map's, which lands time and again,
//   flux_in = flux_escaped + flux_cut + flux_absorbed
// on average: a photon that is stored tells what its surface absorbs, one that goes on what it gives back.
struct Tally {
  std::uint64_t started = 0, kept = 0, visible = 0, stored = 0;  // kept: met a target
  double flux_in = 0, flux_escaped = 0, flux_cut = 0, flux_absorbed = 0;
  double flux_dropped = 0;          // direct light, another map's, or what met nothing
  std::vector<double> flux_landed;  // by material

  // `material`: uint32_t triangle -> material.
  template <class MaterialOf>
  void count(const Fate& photon, const MaterialOf& material_of) {
    ++started;
    if (photon.end == shared::END_DROPPED) {
      flux_dropped += photon.entered;
      return;
    }
    ++kept;
    if (photon.end == shared::END_BLOCKED) return;
    ++visible;
    flux_in += photon.entered;
    flux_absorbed += photon.absorbed;
    flux_cut += photon.cut;
    if (photon.end == shared::END_ESCAPED) flux_escaped += photon.flux;
    if (photon.end >= shared::END_FIRST) return;
    ++stored;
    flux_landed[material_of(photon.end)] += photon.flux;
  }
  void add(const Tally& other) {
    started += other.started, kept += other.kept, visible += other.visible, stored += other.stored;
    flux_in += other.flux_in, flux_escaped += other.flux_escaped, flux_cut += other.flux_cut;
    flux_absorbed += other.flux_absorbed, flux_dropped += other.flux_dropped;
    flux_landed.resize(other.flux_landed.size());
    for (std::size_t i = 0; i < flux_landed.size(); ++i) flux_landed[i] += other.flux_landed[i];
  }
};

using Tallies = std::array<Tally, shared::MAPS>;  // by map

template <class Colour>
double mean_of(const Colour& c) {
  return (double(c.x) + double(c.y) + double(c.z)) / 3;
}

// Which of the camera paths that a pass sends through each pixel.
struct View {
  std::uint32_t sample = 0;                        // below settings.samples: their mean is the pass'
  std::uint32_t branch = shared::BRANCH_ROULETTE;  // of a split path: the light of all is added
  bool bounced = false;  // goes on from the first diffuse surface to the next, whose light it gathers

  // The path whose depth, normal and so on are the pixel's.
  bool main() const { return !bounced && branch != shared::BRANCH_REFLECTED && branch != shared::BRANCH_LATER; }
  // After it, all main paths of the pass are there.
  bool last_main(const RenderSettings& settings) const { return main() && sample + 1 == settings.samples; }
};
inline std::vector<View> views_of(const RenderSettings& settings) {
  std::vector<View> views;
  const auto add = [&](std::uint32_t branch) {
    for (std::uint32_t i = 0; i < settings.samples; ++i) views.push_back({i, branch});
  };
  add(settings.split == 0   ? shared::BRANCH_ROULETTE
      : settings.split == 1 ? shared::BRANCH_THROUGH
                            : shared::BRANCH_THROUGH_ALL);
  if (settings.split > 0) add(shared::BRANCH_REFLECTED);
  if (settings.split > 1) add(shared::BRANCH_LATER);
  for (std::uint32_t i = 0; (settings.final_gathering || settings.bounces_gloss) && i < settings.samples; ++i)
    views.push_back({settings.samples + i, shared::BRANCH_ROULETTE, true});
  return views;
}
// Which maps light that view's samples. What is gathered from has all light but the direct in the global map: a bounce
// later a caustic needs no fine discs, which are dear to look up.
inline bool shows_caustics(const RenderSettings& settings, const View& view) {
  return !view.bounced || !settings.final_gathering;
}
inline bool shows_global(const RenderSettings& settings, const View& view) {
  if (settings.global.count() == 0) return false;
  // Where the map is shown as it is, photons have taken all bounces: of one, a further one by a lobe leaves none.
  if (view.bounced) return settings.final_gathering || settings.diffuse_bounces > 1;
  return !settings.final_gathering;
}
// Part of an outer face's lobe by which the global map is reflected: bounced paths have it where the camera looks.
inline float global_lobe_part(const View& view) { return view.bounced ? 1 : 0; }
// Whether samples that end on the triangle of the one before keep its maps' irradiances: but for round discs, all of a
// pixel are gathered at its centre, so on one triangle at one place.
inline bool keeps_irradiance(const RenderSettings& settings, const View& view) {
  return view.sample > 0 && !view.bounced && carries_differentials(settings);
}
// Of the crop, row by row.
struct Samples {
  std::vector<shared::PixelSample> pixels;
  std::vector<shared::PixelGloss> gloss;  // none where the scene has no outer face that reflects
  // With those of the last main view: radiance of lights seen in menisci, of the whole pass; none without highlights.
  std::vector<glm::vec3> highlights;
};
using TakeSamples = std::function<void(const Samples&, const View&)>;

// The end of a started photon.
struct PhotonEnd {
  std::uint32_t map, end;
  glm::dvec3 position, flux;  // position: of a stored one
};

class Backend {
 public:
  virtual ~Backend() = default;
  // Hands the samples of each of the pass' views to `take`, in the order of views_of; gives how its photons ended.
  virtual Tallies render_pass(std::uint32_t pass, const TakeSamples& take) = 0;
  // The parts of a pass alone: ends of all its photons, and samples without the maps' light.
  virtual std::vector<PhotonEnd> trace_photons(std::uint32_t pass) = 0;
  virtual std::vector<shared::PixelSample> trace_camera(std::uint32_t pass, const View& view) = 0;
  // The samples of a view with the maps' light by the photons of another pass: by which they differ, it is these alone.
  virtual Samples light_camera(std::uint32_t pass, const View& view, std::uint32_t photon_pass) = 0;

  // Other settings from now on, of no more pixels than those before; round discs stay round, and highlights
  // those of the same lights.
  virtual void configure(const RenderSettings& settings) = 0;

  struct Statistics {
    std::string device_name, device_type, driver;
    std::map<std::string, double> seconds{};  // by stage: upload, compile, photons, camera, grid, gather
    std::size_t bytes_peak = 0;               // device memory
    std::uint64_t rays = 0;
    std::uint64_t traversal_limits = 0;  // rays that were cut short: must be 0
    std::uint64_t media_dropped = 0;     // more dielectrics in each other than paths keep count of: must be 0
    gpu::Record record{};                // what ran on the device
    Stages stages{};                     // and on the host
  };
  virtual Statistics statistics() const = 0;
};

}  // namespace meniscal

#include "host/reference/backend.h"

#include "host/reference/camera.h"
#include "host/reference/density.h"
#include "host/reference/path_tracing.h"

namespace meniscal::reference {

std::vector<Photon> ReferenceBackend::photons(std::uint32_t pass, bool global) const {
  const std::uint32_t count = (global ? settings_.global : settings_.caustics).count();
  std::vector<Photon> photons;
  photons.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) photons.push_back(trace_photon(tracer_, settings_, pass, i, {}, global));
  return photons;
}

std::vector<PhotonEnd> ReferenceBackend::trace_photons(std::uint32_t pass) {
  std::vector<PhotonEnd> ends;
  for (const Photon& p : photons(pass, false)) ends.push_back({p.map, p.end, p.position, p.flux});
  return ends;
}

std::vector<shared::PixelSample> ReferenceBackend::trace_camera(std::uint32_t pass, const View& view) {
  const CameraAxes axes = camera_axes(settings_.camera, settings_.width, settings_.height);
  const Crop& crop = settings_.crop;
  std::vector<shared::PixelSample> samples;
  for (std::uint32_t y = crop.y0; y < crop.y1; ++y)
    for (std::uint32_t x = crop.x0; x < crop.x1; ++x)
      samples.push_back(settings_.integrator == Integrator::path
                            ? trace_whole_path(tracer_, settings_, axes, pass, view.sample, x, y)
                            : trace_camera_path(tracer_, settings_, axes, pass, view, x, y));
  return samples;
}

Backend::Statistics ReferenceBackend::statistics() const {
  return {.device_name = "cpu", .device_type = "reference", .driver = "none", .rays = tracer_.rays()};
}

Tallies ReferenceBackend::render_pass(std::uint32_t pass, const TakeSamples& take) {
  Tallies tallies;
  for (Tally& t : tallies) t.flux_landed.resize(world_.surfaces.size());
  const std::vector<Photon> caustics = photons(pass, false), global = photons(pass, true);
  for (const std::vector<Photon>* started : {&caustics, &global})
    for (const Photon& p : *started)
      tallies[p.map].count(mean_of(p.entered), mean_of(p.flux), p.end,
                           [&](std::uint32_t triangle) { return world_.triangles[triangle].material; });

  const PhotonMap caustics_map(caustics, pass_discs(settings_.caustics.discs, pass).widest);
  const PhotonMap global_map(global, pass_discs(settings_.global.discs, pass).widest);
  std::vector<shared::PixelSample> before;
  for (const View& view : views_of(settings_)) {
    std::vector<shared::PixelSample> samples = trace_camera(pass, view);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      shared::PixelSample& sample = samples[i];
      if (sample.triangle >= shared::END_FIRST) continue;
      if (keeps_irradiance(settings_, view) && before[i].triangle == sample.triangle) {
        sample.lit = 1;
        sample.targeted = before[i].targeted, sample.targeted_count = before[i].targeted_count;
        sample.caustic = before[i].caustic, sample.caustic_count = before[i].caustic_count;
        sample.global = before[i].global, sample.global_count = before[i].global_count;
        continue;
      }
      const glm::dvec3 position(sample.position), normal(sample.normal);
      const auto set = [](glm::vec3& irradiance, float& count, const Density& density) {
        irradiance = glm::vec3(density.irradiance);
        count = static_cast<float>(density.photons);
      };
      if (shows_caustics(view)) {
        const auto found = caustics_map.estimate(position, normal);
        set(sample.targeted, sample.targeted_count, found[shared::MAP_TARGETED]);
        set(sample.caustic, sample.caustic_count, found[shared::MAP_CAUSTIC]);
      }
      if (shows_global(settings_, view))
        set(sample.global, sample.global_count, global_map.estimate(position, normal)[shared::MAP_GLOBAL]);
    }
    take(samples, view);
    before = std::move(samples);
  }
  return tallies;
}

}  // namespace meniscal::reference

#include "host/reference/backend.h"

#include "host/reference/camera.h"
#include "host/reference/density.h"

namespace meniscal::reference {

std::vector<Photon> ReferenceBackend::photons(std::uint32_t pass) const {
  std::vector<Photon> photons;
  photons.reserve(settings_.photons());
  for (std::uint32_t i = 0; i < settings_.photons(); ++i) photons.push_back(trace_photon(tracer_, settings_, pass, i));
  return photons;
}

std::vector<PhotonEnd> ReferenceBackend::trace_photons(std::uint32_t pass) {
  std::vector<PhotonEnd> ends;
  for (const Photon& p : photons(pass)) ends.push_back({p.map, p.end, p.position, p.flux});
  return ends;
}

std::vector<shared::PixelSample> ReferenceBackend::trace_camera(std::uint32_t pass, const View& view) {
  const CameraAxes axes = camera_axes(settings_.camera, settings_.width, settings_.height);
  const Crop& crop = settings_.crop;
  std::vector<shared::PixelSample> samples;
  for (std::uint32_t y = crop.y0; y < crop.y1; ++y)
    for (std::uint32_t x = crop.x0; x < crop.x1; ++x)
      samples.push_back(trace_camera_path(tracer_, settings_, axes, pass, view, x, y));
  return samples;
}

Backend::Statistics ReferenceBackend::statistics() const {
  return {.device_name = "cpu", .device_type = "reference", .driver = "none", .rays = tracer_.rays()};
}

Tallies ReferenceBackend::render_pass(std::uint32_t pass, const TakeSamples& take) {
  Tallies tallies;
  const std::vector<Photon> started = photons(pass);
  for (Tally& t : tallies) t.flux_landed.resize(world_.surfaces.size());
  for (const Photon& p : started)
    tallies[p.map].count(mean_of(p.entered), mean_of(p.flux), p.end,
                         [&](std::uint32_t triangle) { return world_.triangles[triangle].material; });

  const PhotonMap map(started, pass_discs(settings_.discs, pass).widest);
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
        continue;
      }
      const auto [targeted, caustic] = map.estimate(glm::dvec3(sample.position), glm::dvec3(sample.normal));
      sample.targeted = glm::vec3(targeted.irradiance);
      sample.targeted_count = static_cast<float>(targeted.photons);
      sample.caustic = glm::vec3(caustic.irradiance);
      sample.caustic_count = static_cast<float>(caustic.photons);
    }
    take(samples, view);
    before = std::move(samples);
  }
  return tallies;
}

}  // namespace meniscal::reference

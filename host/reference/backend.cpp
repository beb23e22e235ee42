#include "host/reference/backend.h"

#include "host/reference/camera.h"
#include "host/reference/density.h"

namespace meniscal::reference {

std::vector<Photon> ReferenceBackend::photons(std::size_t stratum, std::uint32_t pass) const {
  const PhotonSettings settings{settings_.seed, pass, settings_.photons[stratum], settings_.specular_bounces,
                                pass_discs(settings_.discs, pass)};
  std::vector<Photon> photons;
  photons.reserve(settings.started);
  for (std::uint32_t i = 0; i < settings.started; ++i)
    photons.push_back(trace_photon(tracer_, world_.strata[stratum], settings, i));
  return photons;
}

std::vector<PhotonEnd> ReferenceBackend::trace_photons(std::size_t stratum, std::uint32_t pass) {
  std::vector<PhotonEnd> ends;
  for (const Photon& p : photons(stratum, pass)) ends.push_back({p.position, p.flux, p.end});
  return ends;
}

Backend::Statistics ReferenceBackend::statistics() const {
  return {.device_name = "cpu", .device_type = "reference", .driver = "none", .rays = tracer_.rays()};
}

PassResult ReferenceBackend::render_pass(std::uint32_t pass) {
  PassResult result;
  const CameraAxes axes = camera_axes(settings_.camera, settings_.width, settings_.height);
  const Crop& crop = settings_.crop;
  for (std::uint32_t y = crop.y0; y < crop.y1; ++y)
    for (std::uint32_t x = crop.x0; x < crop.x1; ++x)
      result.samples.push_back(trace_camera_path(tracer_, settings_, axes, pass, x, y));

  for (std::size_t s = 0; s < world_.strata.size(); ++s) {
    const std::vector<Photon> started = photons(s, pass);
    Tally tally;
    tally.flux_landed.resize(world_.surfaces.size());
    for (const Photon& p : started)
      tally.count(mean_of(p.entered), mean_of(p.flux), p.end,
                  [&](std::uint32_t triangle) { return world_.triangles[triangle].material; });
    result.tallies.push_back(tally);

    const PhotonMap map(started, pass_discs(settings_.discs, pass).widest);
    const bool targeted = world_.strata[s].stream == shared::STREAM_TARGETED;
    for (shared::PixelSample& sample : result.samples) {
      if (sample.triangle >= shared::END_FIRST) continue;
      const Density d = map.estimate(glm::dvec3(sample.position), glm::dvec3(sample.normal));
      (targeted ? sample.targeted : sample.caustic) = glm::vec3(d.irradiance);
      (targeted ? sample.targeted_count : sample.caustic_count) = static_cast<float>(d.photons);
    }
  }
  return result;
}

}  // namespace meniscal::reference

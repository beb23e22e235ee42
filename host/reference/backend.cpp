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

std::vector<shared::PixelSample> ReferenceBackend::trace_camera(std::uint32_t pass, std::uint32_t branch) {
  const CameraAxes axes = camera_axes(settings_.camera, settings_.width, settings_.height);
  const Crop& crop = settings_.crop;
  std::vector<shared::PixelSample> samples;
  for (std::uint32_t y = crop.y0; y < crop.y1; ++y)
    for (std::uint32_t x = crop.x0; x < crop.x1; ++x)
      samples.push_back(trace_camera_path(tracer_, settings_, axes, pass, branch, x, y));
  return samples;
}

Backend::Statistics ReferenceBackend::statistics() const {
  return {.device_name = "cpu", .device_type = "reference", .driver = "none", .rays = tracer_.rays()};
}

PassResult ReferenceBackend::render_pass(std::uint32_t pass) {
  PassResult result;
  const std::vector<Photon> started = photons(pass);
  for (Tally& t : result.tallies) t.flux_landed.resize(world_.surfaces.size());
  for (const Photon& p : started)
    result.tallies[p.map].count(mean_of(p.entered), mean_of(p.flux), p.end,
                                [&](std::uint32_t triangle) { return world_.triangles[triangle].material; });

  const PhotonMap map(started, pass_discs(settings_.discs, pass).widest);
  const auto render = [&](std::uint32_t branch) {
    std::vector<shared::PixelSample> samples = trace_camera(pass, branch);
    for (shared::PixelSample& sample : samples) {
      if (sample.triangle >= shared::END_FIRST) continue;
      const auto [targeted, caustic] = map.estimate(glm::dvec3(sample.position), glm::dvec3(sample.normal));
      sample.targeted = glm::vec3(targeted.irradiance);
      sample.targeted_count = static_cast<float>(targeted.photons);
      sample.caustic = glm::vec3(caustic.irradiance);
      sample.caustic_count = static_cast<float>(caustic.photons);
    }
    return samples;
  };
  result.samples = render(settings_.split ? shared::BRANCH_THROUGH : shared::BRANCH_ROULETTE);
  if (settings_.split) result.reflected = render(shared::BRANCH_REFLECTED);
  return result;
}

}  // namespace meniscal::reference

#include "host/reference/backend.h"

#include "host/reference/camera.h"
#include "host/reference/density.h"
#include "host/reference/highlights.h"
#include "host/reference/path_tracing.h"
#include "host/render/highlights.h"

namespace meniscal::reference {

std::vector<Photon> ReferenceBackend::photons(std::uint32_t pass, bool global) {
  const std::uint32_t count = (global ? settings_.global : settings_.caustics).count();
  std::vector<Photon> photons;
  if (count == 0) return photons;
  const Stopwatch watch;
  photons.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) photons.push_back(trace_photon(tracer_, settings_, pass, i, {}, global));
  stages_.add(global ? "global photons" : "photons", watch.seconds());
  return photons;
}

std::vector<PhotonEnd> ReferenceBackend::trace_photons(std::uint32_t pass) {
  std::vector<PhotonEnd> ends;
  for (const Photon& p : photons(pass, false)) ends.push_back({p.map, p.end, p.position, p.flux});
  return ends;
}

Samples ReferenceBackend::trace_paths(std::uint32_t pass, const View& view) {
  const Stopwatch watch;
  const CameraAxes axes = camera_axes(settings_.camera, settings_.width, settings_.height);
  const Crop& crop = settings_.crop;
  Samples samples;
  for (std::uint32_t y = crop.y0; y < crop.y1; ++y)
    for (std::uint32_t x = crop.x0; x < crop.x1; ++x) {
      const CameraSample sample = settings_.integrator == Integrator::path
                                      ? trace_whole_path(tracer_, settings_, axes, pass, view.sample, x, y)
                                      : trace_camera_path(tracer_, settings_, axes, pass, view, x, y);
      samples.pixels.push_back(sample.pixel);
      if (world_.glossy) samples.gloss.push_back(sample.gloss);
    }
  stages_.add("camera", watch.seconds());
  return samples;
}

std::vector<glm::vec3> ReferenceBackend::trace_highlights(std::uint32_t pass,
                                                          const std::vector<std::uint32_t>& pixels) const {
  const CameraAxes axes = camera_axes(settings_.camera, settings_.width, settings_.height);
  const Crop& crop = settings_.crop;
  std::vector<glm::vec3> highlights(crop.pixels());
  for (const std::uint32_t i : pixels)
    highlights[i] =
        glm::vec3(highlight(tracer_, settings_, axes, pass, crop.x0 + i % crop.width(), crop.y0 + i / crop.width()));
  return highlights;
}

std::vector<shared::PixelSample> ReferenceBackend::trace_camera(std::uint32_t pass, const View& view) {
  return trace_paths(pass, view).pixels;
}

Backend::Statistics ReferenceBackend::statistics() const {
  return {
      .device_name = "cpu", .device_type = "reference", .driver = "none", .rays = tracer_.rays(), .stages = stages_};
}

namespace {

// The maps' light of another sample at the same place.
void keep(shared::PixelSample& sample, shared::PixelGloss* gloss, const shared::PixelSample& from,
          const shared::PixelGloss* gloss_from) {
  sample.lit = 1;
  sample.targeted = from.targeted, sample.targeted_count = from.targeted_count;
  sample.caustic = from.caustic, sample.caustic_count = from.caustic_count;
  sample.global = from.global, sample.global_count = from.global_count;
  if (gloss)
    gloss->targeted = gloss_from->targeted, gloss->caustic = gloss_from->caustic, gloss->global = gloss_from->global;
}

}  // namespace

void ReferenceBackend::light(shared::PixelSample& sample, shared::PixelGloss* gloss, const View& view,
                             const PhotonMap& caustics, const PhotonMap& global) const {
  const glm::dvec3 position(sample.position), normal(sample.normal), albedo(sample.albedo);
  const bool reflects = gloss && gloss->reflects;
  const Face face = reflects ? Face{glm::dvec3(gloss->normal), glm::dvec3(gloss->outgoing), double(gloss->alpha),
                                    glm::dvec3(gloss->f0), double(gloss->f90)}
                             : Face{};
  const auto set = [&](glm::vec3& irradiance, float& count, glm::vec3 shared::PixelGloss::*beyond,
                       const Density& density) {
    irradiance = glm::vec3(density.irradiance);
    count = static_cast<float>(density.photons);
    if (reflects) gloss->*beyond = glm::vec3(glm::dvec3(gloss->throughput) * density.beyond_lambert);
  };
  if (shows_caustics(settings_, view)) {
    const auto found = caustics.estimate(position, normal, reflects ? &face : nullptr, albedo);
    set(sample.targeted, sample.targeted_count, &shared::PixelGloss::targeted, found[shared::MAP_TARGETED]);
    set(sample.caustic, sample.caustic_count, &shared::PixelGloss::caustic, found[shared::MAP_CAUSTIC]);
  }
  if (shows_global(settings_, view))
    set(sample.global, sample.global_count, &shared::PixelGloss::global,
        global.estimate(position, normal, reflects ? &face : nullptr, albedo,
                        double(global_lobe_part(view)))[shared::MAP_GLOBAL]);
}

PhotonMap ReferenceBackend::make_map(const std::vector<Photon>& photons, const PhotonSet& set,
                                     std::uint32_t pass) const {
  return {photons, pass_discs(set.discs, pass).widest, settings_.kernel};
}

Samples ReferenceBackend::light_camera(std::uint32_t pass, const View& view, std::uint32_t photon_pass) {
  const std::vector<Photon> caustics = photons(photon_pass, false), global = photons(photon_pass, true);
  const PhotonMap caustics_map = make_map(caustics, settings_.caustics, photon_pass);
  const PhotonMap global_map = make_map(global, settings_.global, photon_pass);
  Samples samples = trace_paths(pass, view);
  for (std::size_t i = 0; i < samples.pixels.size(); ++i)
    if (samples.pixels[i].triangle < shared::END_FIRST)
      light(samples.pixels[i], world_.glossy ? &samples.gloss[i] : nullptr, view, caustics_map, global_map);
  return samples;
}

Tallies ReferenceBackend::render_pass(std::uint32_t pass, const TakeSamples& take) {
  Tallies tallies;
  for (Tally& t : tallies) t.flux_landed.resize(world_.surfaces.size());
  const std::vector<Photon> caustics = photons(pass, false), global = photons(pass, true);
  for (const std::vector<Photon>* started : {&caustics, &global})
    for (const Photon& p : *started)
      tallies[p.map].count(p.fate(), [&](std::uint32_t triangle) { return world_.triangles[triangle].material; });

  const bool gathers = !caustics.empty() || !global.empty();
  const Stopwatch sorting;
  const PhotonMap caustics_map = make_map(caustics, settings_.caustics, pass);
  const PhotonMap global_map = make_map(global, settings_.global, pass);
  if (gathers) stages_.add("grid", sorting.seconds());
  Samples before;
  HighlightPixels seeing(settings_.crop);
  for (const View& view : views_of(settings_)) {
    Samples samples = trace_paths(pass, view);
    const Stopwatch gathering;
    for (std::size_t i = 0; i < samples.pixels.size(); ++i) {
      if (samples.pixels[i].triangle >= shared::END_FIRST) continue;
      shared::PixelGloss* gloss = world_.glossy ? &samples.gloss[i] : nullptr;
      if (keeps_irradiance(settings_, view) && before.pixels[i].triangle == samples.pixels[i].triangle)
        keep(samples.pixels[i], gloss, before.pixels[i], gloss ? &before.gloss[i] : nullptr);
      else
        light(samples.pixels[i], gloss, view, caustics_map, global_map);
    }
    if (gathers) stages_.add("gather", gathering.seconds());
    if (view.main()) seeing.add(samples.pixels);
    if (settings_.highlights != shared::HIGHLIGHTS_NONE && view.last_main(settings_))
      if (const auto pixels = seeing.pixels(); !pixels.empty())
        samples.highlights = stages_.run("highlights", [&] { return trace_highlights(pass, pixels); });
    take(samples, view);
    before = std::move(samples);
  }
  return tallies;
}

}  // namespace meniscal::reference

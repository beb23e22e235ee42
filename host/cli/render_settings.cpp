#include "host/cli/render_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/error.h"
#include "host/render/demand.h"
#include "host/render/highlights.h"
#include "host/render/pilot.h"
#include "host/render/plan.h"
#include "host/render/stand_clear.h"
#include "host/render/widening.h"
#include "host/world/light_width.h"
#include "host/world/media.h"

namespace meniscal {
const Camera& find_camera(const Scene& scene, const std::optional<std::string>& name) {
  if (!name) return scene.cameras.front();
  std::string names;
  for (const Camera& c : scene.cameras) {
    if (c.name == *name) return c;
    names += (names.empty() ? "" : ", ") + c.name;
  }
  throw Error(ExitCode::usage, fmt::format("--camera {}: {} has no such camera; it has {}", *name, scene.file, names));
}

Resolution size_of(const Camera& camera, int width) {
  const double aspect = camera.orthographic ? camera.xmag / camera.ymag : camera.aspect > 0 ? camera.aspect : 4.0 / 3.0;
  return {width, static_cast<int>(std::max(1.0, std::round(width / aspect)))};
}

std::uint32_t highlight_samples_of(const RenderOptions& options, const Scene& scene) {
  if (options.highlight_samples) return *options.highlight_samples;
  return narrowest_light(scene) > kHidingLight ? RenderOptions::default_highlight_samples
                                               : preset(options.quality).spark_samples;
}

namespace {

// Pixels of the whole image: as asked for, or as wide as by default and as high as the camera's aspect wants.
void choose_size(RenderSettings& settings, const RenderOptions& options) {
  const Resolution size = options.resolution.value_or(size_of(settings.camera, RenderOptions::default_width));
  settings.width = static_cast<std::uint32_t>(size.width);
  settings.height = static_cast<std::uint32_t>(size.height);
  settings.crop = options.crop.value_or(Crop{0, 0, settings.width, settings.height});
  if (settings.crop.x1 > settings.width || settings.crop.y1 > settings.height)
    throw Error(ExitCode::usage, fmt::format("--crop reaches to {},{}, beyond the image's {}x{}", settings.crop.x1,
                                             settings.crop.y1, settings.width, settings.height));
}

// Before anything is known of what is seen.
Budgets default_budgets(const RenderSettings& settings) {
  if (settings.diffuse_bounces == 0) return {settings.photons, 0};
  return {settings.photons, std::max(settings.photons / (settings.final_gathering ? 4 : 2), 1000u)};
}

// Interreflection is smooth: discs hold some two hundred photons where these are spread over the scene evenly. Fewer
// where they are gathered from, which evens out noise, but not what discs lose beyond the edges of surfaces. Of more
// photons, discs hold more and are smaller: so noise and blur fall alike. Where the camera sees photons crowded, discs
// are smaller by `narrowing`: there are enough, and to gather more of them costs time and detail.
void set_global(RenderSettings& settings, const World& world, std::uint32_t photons, double narrowing = 1) {
  if (photons == 0) return;
  settings.global.scatterings = settings.diffuse_bounces - (settings.final_gathering ? 1 : 0);
  settings.global.keeps_caustics = settings.final_gathering;
  settings.global.beams = global_beams(world, photons, settings.integrator == Integrator::ordinary);
  if (settings.global.beams.empty()) return;
  const double usual = default_budgets(settings).global, more = settings.global.count() / usual;
  const double held = (settings.final_gathering ? 20 : 200) * std::pow(more, 2.0 / 3);
  const double radius = narrowing * world.radius * std::sqrt(held / settings.global.count());
  settings.global.discs = {radius, radius};
}

// Where nothing is specular there is nothing to look ahead for: no starts, and no paths to split.
bool any_specular(const World& world) {
  return std::any_of(world.surfaces.begin(), world.surfaces.end(),
                     [](const shared::Surface& s) { return s.kind != shared::SPECULAR_NONE || s.specular > 0; });
}

void set_beams(RenderSettings& settings, const RenderOptions& options, const World& world,
               std::vector<shared::Beam> beams) {
  settings.caustics.beams = std::move(beams);
  settings.caustics.discs =
      options.radius ? Discs{*options.radius, *options.radius} : default_discs(settings, world.radius);
}

}  // namespace

World build_world(const RenderOptions& options, const Scene& scene) {
  RenderSettings view;
  view.camera = find_camera(scene, options.camera);
  choose_size(view, options);
  std::optional<Demand> demand;  // none of a scene without contacts
  return build_world(scene, options.meniscus,
                     {options.meniscus_tolerance, [&](std::span<const glm::dvec3> beside, double capillary_length) {
                        if (!demand) demand.emplace(scene, view);
                        return demand->need(beside, capillary_length);
                      }});
}

RenderSettings choose_settings(const RenderOptions& options, const Scene& scene, const World& world) {
  RenderSettings settings;
  settings.seed = options.seed;
  settings.integrator = options.integrator;
  settings.kernel = options.kernel;
  settings.specular_bounces = options.specular_bounces;
  settings.diffuse_bounces = world.lights.empty() ? 0 : options.diffuse_bounces;
  settings.camera = find_camera(scene, options.camera);
  choose_size(settings, options);
  settings.camera.pose[3] = glm::dvec4(stand_clear(world, glm::dvec3(settings.camera.pose[3])), 1);
  settings.camera_media = media_at(world, camera_axes(settings.camera, settings.width, settings.height).origin);
  settings.footprint = pixel_footprint(world, settings);
  const Preset usual = preset(options.quality);
  const bool gathers = settings.diffuse_bounces > 0 && options.final_gathering.value_or(usual.final_gathering);
  const PassCounts counts = usual.counts(settings.crop.pixels(), gathers && options.integrator != Integrator::path);
  settings.photons = options.photons.value_or(counts.photons);
  // Photons that do not fit at once would be traced anew for each sample: passes are cheaper then.
  settings.samples = options.samples.value_or(settings.photons > settings.photons_at_once ? 1 : counts.samples);
  if (options.integrator == Integrator::path) return settings;
  const std::uint32_t rays = highlight_samples_of(options, scene);
  if (rays > 0) {
    settings.highlights = find_highlights(world).lights;
    settings.highlight_cells = static_cast<std::uint32_t>(std::max(1.0, std::round(std::sqrt(rays))));
  }
  settings.final_gathering = gathers;
  set_beams(settings, options, world,
            options.integrator == Integrator::ordinary ? light_beams(world, settings.photons)
                                                       : make_beams(world, default_starts(world), settings.photons));
  set_global(settings, world, default_budgets(settings).global);
  // Smooth faces have no lobe to follow.
  settings.bounces_gloss = world.glossy && settings.diffuse_bounces > 0 &&
                           std::any_of(world.surfaces.begin(), world.surfaces.end(), [](const shared::Surface& s) {
                             return s.alpha > 0 && (s.specular < 1 || s.textures != 0);
                           });
  return settings;
}

bool focus(RenderSettings& settings, const RenderOptions& options, const World& world, Backend& backend) {
  if (settings.integrator != Integrator::targeted || !any_specular(world)) return false;
  const Pilot pilot = look_ahead(backend, world, settings);
  settings.split = pilot.split;
  // In the mean, discs may hold eight times what they would of photons spread evenly: dim places then have some, too.
  const double narrowing = std::sqrt(1 / std::max(pilot.crowding / 8, 1.0));
  MapNoise noise = pilot.noise;
  noise.global /= narrowing * narrowing;
  const Budgets budgets = share_photons({settings.photons, settings.global.count()}, noise);
  const bool fits = preset(options.quality).fits_footprints && !options.radius && budgets.caustics > 0;
  const double widening = fits ? find_widening(backend, world, settings, pilot.starts, budgets.caustics) : 1;
  set_beams(settings, options, world, make_beams(world, pilot.starts, budgets.caustics, widening));
  set_global(settings, world, budgets.global, narrowing);
  backend.configure(settings);
  return true;
}

}  // namespace meniscal

#include "host/render/statistics.h"

#include <fmt/format.h>

#include <sys/resource.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/render/contacts.h"

namespace meniscal {
namespace {

using Json = nlohmann::ordered_json;

Json plan_json(const World& world, const RenderSettings& settings) {
  Json entries = Json::array();
  for (const PlanEntry& e :
       make_plan(world, settings.diffuse_bounces, settings.camera_media, settings.highlight_cells > 0))
    entries.push_back({{"feature", e.feature}, {"on", e.on}, {"why", e.why}});
  return entries;
}

Json meniscus_json(const World& world, MeniscusModel model) {
  std::size_t contours = 0, triangles = 0;
  double low = 0, high = 0;
  for (const LiquidReport& l : world.liquids) {
    triangles += l.triangles;
    for (const meniscus::Contact& c : l.contacts) {
      low = contours == 0 ? c.rise_min : std::min(low, c.rise_min);
      high = contours == 0 ? c.rise_max : std::max(high, c.rise_max);
      ++contours;
    }
  }
  meniscus::Solution solution;
  for (const LiquidReport& l : world.liquids) solution.add(l.solution);
  Json json{{"model", name_of(model)},
            {"contours", contours},
            {"contacts", contacts_json(world)},
            {"triangles", triangles},
            {"rise_min_m", low},
            {"rise_max_m", high},
            {"seconds", world.meniscus_seconds},
            {"warnings", world.warnings}};
  if (model == MeniscusModel::exact)
    json["solution"] = {{"parts", solution.parts},           {"failed", solution.failed},
                        {"unknowns", solution.unknowns},     {"newton_steps", solution.steps},
                        {"last_step_m", solution.last_step}, {"height_error_m", solution.height_error}};
  return json;
}

// Fluxes are those of the light itself: means over the passes, each of which estimates the whole.
Json tally_json(const World& world, const Tally& t, std::uint32_t passes) {
  const double scale = passes > 0 ? 1.0 / passes : 0;
  Json landed = Json::object();
  for (std::size_t i = 0; i < t.flux_landed.size(); ++i) {
    if (t.flux_landed[i] == 0) continue;
    const double before = landed.value(world.material_names[i], 0.0);  // materials may share a name
    landed[world.material_names[i]] = before + t.flux_landed[i] * scale;
  }
  return {{"started", t.started},
          {"kept", t.kept},
          {"visible", t.visible},
          {"stored", t.stored},
          {"flux_in", t.flux_in * scale},
          {"flux_landed", landed},
          {"flux_escaped", t.flux_escaped * scale},
          {"flux_cut", t.flux_cut * scale},
          {"flux_absorbed", t.flux_absorbed * scale},
          {"flux_dropped", t.flux_dropped * scale}};
}

Json photons_json(const World& world, const RunStatistics& run, std::uint32_t passes) {
  Json maps = Json::object();
  std::uint64_t started = 0, stored = 0;
  const char* names[shared::MAPS] = {"targeted", "caustic", "global"};
  for (std::size_t map = 0; map < shared::MAPS; ++map) {
    maps[names[map]] = tally_json(world, run.tallies[map], passes);
    started += run.tallies[map].started;
    stored += run.tallies[map].stored;
  }
  Json photons = {{"started", started}, {"stored", stored}};
  photons.update(maps);
  return photons;
}

// Radius of the discs of what is neither focused nor spread, in the first and the last pass.
Json radius_json(const RenderSettings& settings, const PassRange& passes) {
  if (settings.caustics.beams.empty() || passes.last == passes.first) return Json::array();
  return {disc_radius(settings, passes.first), disc_radius(settings, passes.last - 1)};
}

// What the render was not without: passes, shader variants, buffers and stages, as they were noted where they ran.
Json ran_json(const World& world, const RunStatistics& run) {
  Json passes = Json::array();
  for (const gpu::PassRecord& p : run.backend.record.passes)
    passes.push_back({{"name", p.name}, {"variant", p.variant}, {"dispatches", p.dispatches}});
  Stages stages = run.stages;
  stages.add(world.stages);
  stages.add(run.backend.stages);
  return {{"passes", passes}, {"buffers", run.backend.record.buffers}, {"stages", stages.seconds()}};
}

std::size_t host_peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::size_t(usage.ru_maxrss) * 1024;
}

}  // namespace

std::vector<std::string> limits_hit(const Backend::Statistics& backend) {
  std::vector<std::string> warnings;
  if (backend.traversal_limits > 0)
    warnings.push_back(fmt::format("{} rays were cut short in the hierarchy; the picture lacks their light",
                                   backend.traversal_limits));
  if (backend.media_dropped > 0)
    warnings.push_back(
        fmt::format("{} times a path was inside more than 4 transparent volumes at once; it forgot the one of the "
                    "lowest dielectric_priority",
                    backend.media_dropped));
  return warnings;
}

Json statistics_json(const World& world, const RenderSettings& settings, MeniscusModel model,
                     const RunStatistics& run) {
  std::map<std::string, double> seconds = run.seconds;
  for (const char* stage : {"upload", "compile", "photons", "grid", "gather"}) seconds[stage] = 0;
  for (const auto& [stage, time] : run.backend.seconds) seconds[stage] = time;
  seconds["meniscus"] = world.meniscus_seconds;
  seconds["bvh"] = world.bvh_seconds;
  const std::uint32_t passes = run.passes.last - run.passes.first;
  return {{"device",
           {{"name", run.backend.device_name}, {"type", run.backend.device_type}, {"driver", run.backend.driver}}},
          {"plan", plan_json(world, settings)},
          {"meniscus", meniscus_json(world, model)},
          {"triangles", world.triangles.size()},
          {"photons", photons_json(world, run, passes)},
          {"passes", passes},
          {"stopped_by", to_text(run.stop)},
          {"radius_m", radius_json(settings, run.passes)},
          {"error_estimate", run.error_estimate < 0 ? Json() : Json(run.error_estimate)},
          {"seconds", seconds},
          {"ran", ran_json(world, run)},
          {"rays", run.backend.rays},
          {"rays_cut_short", run.backend.traversal_limits},
          {"media_dropped", run.backend.media_dropped},
          {"bytes", {{"device_peak", run.backend.bytes_peak}, {"host_peak", host_peak_bytes()}}}};
}

}  // namespace meniscal

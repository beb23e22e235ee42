#include "host/render/plan.h"

#include <fmt/format.h>
#include <algorithm>

#include "host/render/highlights.h"
#include "host/world/media.h"
#include "shaders/shared/material.h"

namespace meniscal {
namespace {

std::size_t count_surfaces(const World& world, std::uint32_t kind) {
  return std::count_if(world.surfaces.begin(), world.surfaces.end(), [&](const auto& s) { return s.kind == kind; });
}
template <class Type>
std::size_t count_lights(const World& world, Type type) {
  return std::count_if(world.lights.begin(), world.lights.end(), type);
}

PlanEntry counted(const std::string& feature, std::size_t count, const std::string& what) {
  return {feature, count > 0, count > 0 ? fmt::format("{} {}", count, what) : fmt::format("no {}", what)};
}

const Stratum* find_stratum(const World& world, const std::string& name) {
  for (const Stratum& s : world.strata)
    if (s.name == name) return &s;
  return nullptr;
}

}  // namespace

Plan make_plan(const World& world, std::uint32_t diffuse_bounces, const glm::uvec4& camera_media, bool highlights) {
  std::size_t contacts = 0, level = 0, unseen = 0;
  for (const LiquidReport& l : world.liquids) {
    (l.triangles > 0 ? contacts : level) += l.contacts.size();
    for (const meniscus::Contact& c : l.contacts) unseen += c.triangles > 0 && !c.need.target;
  }
  Plan plan;
  plan.push_back(counted("menisci", contacts, "liquid-solid contacts"));
  if (unseen > 0) plan.back().why += fmt::format(", {} of them without light or out of sight", unseen);
  if (contacts == 0 && level > 0) plan.back().why = "the liquid stays level where it meets solids";
  for (const char* map : {"targeted", "caustic"}) {
    const Stratum* s = find_stratum(world, map);
    PlanEntry entry = counted(std::string(map) + " map", s ? s->count : 0,
                              map == std::string("targeted") ? "meniscus triangles" : "other specular triangles");
    if (entry.on && world.lights.empty()) entry = {entry.feature, false, "no light"};
    plan.push_back(entry);
  }
  const Highlights shown = find_highlights(world);
  plan.push_back({"highlights", highlights && shown.lights != shared::HIGHLIGHTS_NONE,
                  highlights ? shown.why : "no rays are to look for them"});
  plan.push_back({"interreflection", diffuse_bounces > 0 && !world.lights.empty(),
                  world.lights.empty() ? "no light" : fmt::format("{} diffuse bounces", diffuse_bounces)});
  using shared::Light;
  plan.push_back(counted("directional lights",
                         count_lights(world, [](const Light& l) { return l.type == shared::LIGHT_DIRECTIONAL; }),
                         "directional lights"));
  plan.push_back(counted("suns", world.suns, "directional lights with an angular diameter"));
  const SampledEnvironment& environment = world.environment;
  plan.push_back({"environment", environment.columns > 0,
                  environment.columns > 0 ? fmt::format("{} x {} pixels", environment.columns, environment.rows)
                                          : "no light from beyond the scene"});
  plan.push_back(counted(
      "point and spot lights",
      count_lights(world, [](const Light& l) { return l.type == shared::LIGHT_POINT || l.type == shared::LIGHT_SPOT; }),
      "point or spot lights"));
  plan.push_back(counted("area lights",
                         count_lights(world, [](const Light& l) { return l.type == shared::LIGHT_AREA; }),
                         "emissive triangles"));
  plan.push_back(counted("refraction", count_surfaces(world, shared::SPECULAR_DIELECTRIC), "refracting materials"));
  const std::string nested = why_nested(world, camera_media);
  plan.push_back(
      {"nested dielectrics", !nested.empty(), nested.empty() ? "no two transparent volumes overlap" : nested});
  plan.push_back(counted("thin sheets", count_surfaces(world, shared::SPECULAR_THIN), "thin-walled materials"));
  plan.push_back(counted("mirrors", count_surfaces(world, shared::SPECULAR_MIRROR), "smooth metals or lacquers"));
  plan.push_back(
      {"gloss", world.glossy,
       world.glossy ? "outer faces reflect above diffuse surfaces" : "no outer face above a diffuse surface reflects"});
  plan.push_back(counted("frosted glass",
                         std::count_if(world.surfaces.begin(), world.surfaces.end(), shared::is_rough_specular),
                         "rough transparent materials"));
  plan.push_back(counted("textures", world.textures.size(), "textures"));
  plan.push_back(counted("absorption",
                         std::count_if(world.surfaces.begin(), world.surfaces.end(),
                                       [](const auto& s) { return s.absorption != glm::vec3(0); }),
                         "absorbing volumes"));
  return plan;
}

Discs default_discs(const RenderSettings& settings, double radius) {
  if (settings.integrator == Integrator::ordinary) {
    // Some fifty photons where they are spread over the scene evenly.
    const double round = radius * std::sqrt(50.0 / std::max(settings.caustics.count(), 50u));
    return {round, round};
  }
  // Measured on the benchmark: discs narrower than this part of a pixel alias, wider ones blur folds. The grid's levels
  // span a factor of 128 between the narrowest and the widest.
  constexpr double narrowest = 0.85, most_pixels = 27, levels = 100;
  double widest = most_pixels * settings.footprint;
  for (const shared::Beam& b : settings.caustics.beams) widest = std::max(widest, double(b.reach));
  return {narrowest * settings.footprint, std::min(widest, levels * narrowest * settings.footprint)};
}

}  // namespace meniscal

#include "host/world/menisci.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "host/error.h"

namespace meniscal {

const char* name_of(MeniscusModel model) {
  switch (model) {
    case MeniscusModel::none:
      return "none";
    case MeniscusModel::paper:
      return "paper";
    case MeniscusModel::exact:
      break;
  }
  return "exact";
}

double capillary_length(const LiquidProperties& liquid, double gravity) {
  return std::sqrt(liquid.surface_tension / (liquid.density * gravity));
}

double contact_angle(const Material& solid, const Material& liquid) {
  const auto with = solid.contact_angle_with.find(liquid.name);
  if (with != solid.contact_angle_with.end()) return with->second;
  return solid.contact_angle.value_or(liquid.liquid->default_contact_angle);
}

namespace {

meniscus::Liquid make_liquid(const Scene& scene, const Object& object, MeniscusModel model,
                             const MeniscusTolerance& tolerance) {
  const LiquidProperties& p = *scene.materials[object.material].liquid;
  meniscus::Liquid liquid{.name = object.name,
                          .mesh = object.mesh,
                          .capillary_length = capillary_length(p, scene.gravity),
                          .height_scale = model == MeniscusModel::none ? 0 : p.height_scale,
                          .sweep_scale = p.sweep_scale};
  using enum meniscus::HeightRule;
  using enum meniscus::Profile;
  liquid.height_rule = p.height_rule == "equation2" ? equation2 : p.height_rule == "exact" ? exact : wetting;
  liquid.profile = p.profile == "exponential" ? exponential
                   : p.profile == "circular"  ? circular
                   : p.profile == "bessel"    ? bessel
                                              : sine;
  if (model == MeniscusModel::exact) {
    liquid.profile = meniscus::Profile::solved;
    if (liquid.height_scale != 0) liquid.height_scale = 1;
  }
  liquid.flatten = p.flatten;
  liquid.tolerance = tolerance.factor;
  if (p.tolerance) liquid.tolerance *= *p.tolerance / (meniscus::kHeightTolerance * liquid.capillary_length);
  if (tolerance.need && liquid.height_scale != 0)
    liquid.need = [&tolerance, length = liquid.capillary_length](std::span<const glm::dvec3> beside) {
      return tolerance.need(beside, length);
    };
  return liquid;
}

std::vector<meniscus::Solid> solids_for(const Scene& scene, const Material& liquid) {
  std::vector<meniscus::Solid> solids;
  for (const Object& o : scene.objects) {
    const Material& m = scene.materials[o.material];
    if (!m.liquid && !m.target && !m.meniscus_ignore)
      solids.push_back({o.name, o.mesh, glm::radians(contact_angle(m, liquid))});
  }
  return solids;
}

}  // namespace

std::vector<LiquidSurface> raise_menisci(const Scene& scene, MeniscusModel model, const MeniscusTolerance& tolerance,
                                         std::vector<std::string>& warnings, Stages& stages) {
  std::vector<LiquidSurface> liquids;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    const Material& material = scene.materials[object.material];
    if (!material.liquid) continue;
    const Stopwatch watch;
    try {
      liquids.push_back(
          {i, meniscus::build(make_liquid(scene, object, model, tolerance), solids_for(scene, material))});
    } catch (const std::invalid_argument& error) {
      throw Error(ExitCode::scene, scene.file + ": " + error.what());
    }
    const meniscus::Surface& surface = liquids.back().surface;
    const bool any_meniscus = std::find(surface.meniscus.begin(), surface.meniscus.end(), 1) != surface.meniscus.end();
    stages.add(any_meniscus ? "menisci" : "level liquids", watch.seconds());
    const LiquidProperties& p = *material.liquid;
    if (model == MeniscusModel::exact && !surface.contacts.empty() &&
        ((p.height_scale != 1 && p.height_scale != 0) || p.sweep_scale != 1))
      warnings.push_back(
          fmt::format("{}: liquid '{}': the scales of its menisci's height and sweep belong to the paper's "
                      "profile; the exact one knows none (--meniscus paper)",
                      scene.file, object.name));
    for (const std::string& w : surface.warnings) warnings.push_back(fmt::format("{}: {}", scene.file, w));
  }
  return liquids;
}

}  // namespace meniscal

#include "host/render/plan.h"

#include <fmt/format.h>
#include <algorithm>
#include <limits>

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

Plan make_plan(const World& world) {
  std::size_t contacts = 0;
  for (const LiquidReport& l : world.liquids) contacts += l.contacts.size();
  Plan plan;
  plan.push_back(counted("menisci", contacts, "liquid-solid contacts"));
  for (const char* map : {"targeted", "caustic"}) {
    const Stratum* s = find_stratum(world, map);
    PlanEntry entry = counted(std::string(map) + " map", s ? s->count : 0,
                              map == std::string("targeted") ? "meniscus triangles" : "other specular triangles");
    if (entry.on && world.lights.empty()) entry = {entry.feature, false, "no light"};
    plan.push_back(entry);
  }
  using shared::Light;
  plan.push_back(counted("directional lights",
                         count_lights(world, [](const Light& l) { return l.type == shared::LIGHT_DIRECTIONAL; }),
                         "directional lights"));
  plan.push_back(counted(
      "point and spot lights",
      count_lights(world, [](const Light& l) { return l.type == shared::LIGHT_POINT || l.type == shared::LIGHT_SPOT; }),
      "point or spot lights"));
  plan.push_back(counted("area lights",
                         count_lights(world, [](const Light& l) { return l.type == shared::LIGHT_AREA; }),
                         "emissive triangles"));
  plan.push_back(counted("refraction", count_surfaces(world, shared::SPECULAR_DIELECTRIC), "refracting materials"));
  plan.push_back(counted("thin sheets", count_surfaces(world, shared::SPECULAR_THIN), "thin-walled materials"));
  plan.push_back(counted("mirrors", count_surfaces(world, shared::SPECULAR_MIRROR), "smooth metals"));
  plan.push_back(counted("absorption",
                         std::count_if(world.surfaces.begin(), world.surfaces.end(),
                                       [](const auto& s) { return s.absorption != glm::vec3(0); }),
                         "absorbing volumes"));
  return plan;
}

std::vector<std::uint32_t> photon_budget(const World& world, std::uint32_t photons) {
  double total = 0;
  for (const Stratum& s : world.strata) total += std::sqrt(s.area);
  std::vector<std::uint32_t> budget;
  for (const Stratum& s : world.strata) {
    const double share = 0.5 * (std::sqrt(s.area) / total + 1.0 / double(world.strata.size()));
    budget.push_back(world.lights.empty() ? 0 : static_cast<std::uint32_t>(photons * share));
  }
  return budget;
}

Discs default_discs(const World& world, const std::vector<std::uint32_t>& photons, double footprint) {
  // Measured on the benchmark: discs narrower than this part of a pixel alias, wider ones blur folds; discs of fewer
  // spacings are noisy, and the stratum whose starts are furthest apart puts up with half as many.
  constexpr double narrowest = 0.85, fine_spacings = 4, coarse_spacings = 2, most_pixels = 27;
  double finest = std::numeric_limits<double>::infinity(), coarsest = footprint;
  for (std::size_t i = 0; i < world.strata.size(); ++i) {
    const Stratum& s = world.strata[i];
    const double spacing = std::sqrt(s.start_area() / std::max(photons[i], 1u));
    finest = std::min(finest, spacing);
    coarsest = i == 0 ? spacing : std::max(coarsest, spacing);
  }
  const double reach = std::max(fine_spacings * std::min(finest, coarsest), coarse_spacings * coarsest);
  // The grid's levels span a factor of 128 between the narrowest and the widest.
  return {reach, std::max(narrowest * footprint, reach / 100), std::max(most_pixels * footprint, reach)};
}

}  // namespace meniscal

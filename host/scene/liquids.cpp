#include "host/scene/liquids.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace meniscal::gltf {
namespace {

// Water: physics.md, section 1. Seawater (35 g/kg): Nayar et al. 2014, Millero & Huang 2009, Quan & Fry 1995. The
// others: CRC Handbook of Chemistry and Physics; olive oil varies by some per cent with its origin.
constexpr std::array<NamedLiquid, 6> table = {{{"water", 0.0728, 998.2, 1.333, false, 30},
                                               {"seawater", 0.0738, 1024.8, 1.3394, false, 30},
                                               {"ethanol", 0.0224, 789.3, 1.3611, false, 30},
                                               {"glycerol", 0.0634, 1261, 1.4729, false, 30},
                                               {"olive oil", 0.032, 911, 1.468, false, 30},
                                               {"mercury", 0.4855, 13546, 1.5, true, 140}}};

}  // namespace

const NamedLiquid* named_liquid(std::string_view name) {
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const NamedLiquid& liquid) { return liquid.name == name; });
  return found == table.end() ? nullptr : &*found;
}

std::optional<LiquidProperties> read_liquid(const Extras& extras) {
  const auto name =
      extras.text("meniscus_liquid", {"water", "seawater", "ethanol", "glycerol", "olive oil", "mercury", "custom"});
  const auto tension = extras.number("meniscus_surface_tension", {0, 10, true});
  const auto density = extras.number("meniscus_density", {0, 1e5, true});
  if (!name && !tension && !density) return std::nullopt;

  const NamedLiquid* known = name ? named_liquid(*name) : nullptr;
  if (known == nullptr && (!tension || !density))
    extras.messages().fail(extras.object(),
                           fmt::format("has no {}", tension ? "meniscus_density" : "meniscus_surface_tension"),
                           "a liquid of its own needs meniscus_surface_tension (N/m) and meniscus_density (kg/m3)");
  LiquidProperties liquid;
  liquid.kind = name.value_or("custom");
  liquid.surface_tension = tension ? *tension : known->surface_tension;
  liquid.density = density ? *density : known->density;
  if (known != nullptr) {
    liquid.opaque = known->opaque;
    liquid.default_contact_angle = known->contact_angle;
  }
  liquid.height_scale = extras.number("meniscus_height_scale", {0, 1000}).value_or(liquid.height_scale);
  liquid.sweep_scale = extras.number("meniscus_sweep_scale", {0, 1000, true}).value_or(liquid.sweep_scale);
  liquid.profile =
      extras.text("meniscus_profile", {"sine", "exponential", "circular", "bessel"}).value_or(liquid.profile);
  liquid.height_rule =
      extras.text("meniscus_height_rule", {"wetting", "equation2", "exact"}).value_or(liquid.height_rule);
  liquid.flatten = extras.flag("meniscus_flatten");
  liquid.tolerance = extras.number("meniscus_tolerance", {0, 1, true});
  return liquid;
}

}  // namespace meniscal::gltf

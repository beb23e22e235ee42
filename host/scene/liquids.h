// Liquids: the named ones' properties, and the `extras` that make a material a liquid (interface.md, "Scenes").
#pragma once

#include <optional>
#include <string_view>

#include "host/scene/extras.h"
#include "host/scene/scene.h"

namespace meniscal::gltf {

// Literature values at 20 C.
struct NamedLiquid {
  std::string_view name;
  double surface_tension;  // N/m, against air
  double density;          // kg/m3
  double ior;              // at 589 nm
  bool opaque;
  double contact_angle;  // degrees, of solids that state none
};

// Null for "custom" and for names not in the table.
const NamedLiquid* named_liquid(std::string_view name);

// The liquid that a material's extras describe: `meniscus_liquid`, or surface tension and density ("custom"); none
// otherwise.
std::optional<LiquidProperties> read_liquid(const Extras& extras);

}  // namespace meniscal::gltf

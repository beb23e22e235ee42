// The liquids of a scene with the menisci that its solids raise in them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "host/scene/scene.h"
#include "meniscus/meniscus.h"

namespace meniscal {

enum class MeniscusModel { none, paper, exact };
const char* name_of(MeniscusModel model);

// sqrt(surface tension / (density * gravity)), metres: the paper's length unit, section 3.
double capillary_length(const LiquidProperties& liquid, double gravity);
// Degrees, by the liquid's material; a solid that says nothing takes the liquid's default.
double contact_angle(const Material& solid, const Material& liquid);

struct LiquidSurface {
  std::size_t object;  // of the scene; liquid
  meniscus::Surface surface;
};

// One for each liquid object, in their order; `none` cuts the liquids where solids pierce them, level. Deterministic.
// `tolerance` is a factor on how far the menisci may be off. `stages`: "menisci" of liquids that solids raise some in,
// "level liquids" of others. Throws Error(ExitCode::scene).
std::vector<LiquidSurface> raise_menisci(const Scene& scene, MeniscusModel model, double tolerance,
                                         std::vector<std::string>& warnings, Stages& stages);

}  // namespace meniscal

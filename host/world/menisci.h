// The liquids of a scene with the menisci that its solids raise in them.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
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

// How far menisci may be off: a factor on all of them, and what a picture needs of each, as in meniscus::Liquid, by the
// liquid's capillary length, metres.
struct MeniscusTolerance {
  double factor = 1;
  std::function<meniscus::Need(std::span<const glm::dvec3> beside, double capillary_length)> need{};
};

// One for each liquid object, in their order; `none` cuts the liquids where solids pierce them, level. Deterministic.
// `stages`: "menisci" of liquids that solids raise some in,
// "level liquids" of others. Throws Error(ExitCode::scene).
std::vector<LiquidSurface> raise_menisci(const Scene& scene, MeniscusModel model, const MeniscusTolerance& tolerance,
                                         std::vector<std::string>& warnings, Stages& stages);

}  // namespace meniscal

// The statistics of a render, as interface lays them down.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "host/render/backend.h"
#include "host/render/film.h"
#include "host/render/plan.h"
#include "host/render/progressive.h"
#include "host/render/stopping.h"

namespace meniscal {

struct RunStatistics {
  Backend::Statistics backend;
  Tallies tallies;                        // sums over the passes
  PassRange passes;                       // that were rendered
  Stop stop = Stop::passes;               // why there were no more
  double error_estimate = -1;             // negative: unknown
  std::map<std::string, double> seconds;  // of the host's stages: load, write, total
  Stages stages;  // of the host that not all renders have, but for the world's and the backend's
};

// Warnings: bounds that the rendering ran into, and what they cost the picture.
std::vector<std::string> limits_hit(const Backend::Statistics& backend);

nlohmann::ordered_json statistics_json(const World& world, const RenderSettings& settings, MeniscusModel model,
                                       const RunStatistics& run);

}  // namespace meniscal

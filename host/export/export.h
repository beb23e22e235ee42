// From a scene file to the same scene with its menisci.
#pragma once

#include <string>
#include <vector>

#include "host/export/document.h"
#include "host/world/menisci.h"

namespace meniscal::gltf {

struct Exported {
  Document document;
  std::vector<LiquidSurface> liquids;  // that it now holds
  std::string environment_file;        // that it names, beside itself as beside the scene; empty: none
  std::vector<std::string> warnings;
};

// Throws Error(ExitCode::scene).
Exported export_with_menisci(const std::string& path, MeniscusModel model, double meniscus_tolerance = 1);

}  // namespace meniscal::gltf

// What `meniscal render` was asked for.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/image/tonemap.h"
#include "host/render/film.h"
#include "host/render/progressive.h"

namespace meniscal {

struct Resolution {
  int width = 0, height = 0;
};

struct RenderOptions {
  std::string scene;
  std::string output;  // never empty after parsing: by default the scene's name with .exr, in the current folder

  std::string device = "auto";
  MeniscusModel meniscus = MeniscusModel::exact;
  std::uint32_t photons = 500000;       // per pass, all strata together
  std::optional<std::uint32_t> passes;  // not given: default_passes, or the range's
  std::optional<PassRange> pass_range;
  std::optional<double> radius;  // gather radius of pass 0, metres; not given: from pixel footprint and photon density
  std::uint32_t diffuse_bounces = 0, specular_bounces = 16;
  std::uint32_t seed = 0;
  MapScale map_scale;

  std::optional<Resolution> resolution;  // not given: default_width, and the camera's aspect
  std::optional<Crop> crop;              // lies within the resolution where both are given
  std::optional<std::string> camera;     // not given: the first

  std::optional<std::string> preview;  // PNG
  ToneMap tonemap = ToneMap::ward;
  std::optional<double> exposure;    // EV
  std::optional<std::string> stats;  // JSON
  std::vector<std::string> aovs;     // of aov_names(), in that order, "all" resolved

  bool quiet = false, json_progress = false;

  static constexpr std::uint32_t default_passes = 16;
  static constexpr int default_width = 640;

  // The passes to run: those of --pass-range below --passes. Never empty after parsing.
  PassRange passes_to_run() const;
};

// Adds scene and options to the subcommand; `options` must outlive the parsing. Values that are wrong by themselves, or
// contradict each other, end it with a CLI::ParseError that names the option: exit code 2.
void add_render_options(CLI::App& command, RenderOptions& options);

}  // namespace meniscal

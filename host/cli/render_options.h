// What `meniscal render` was asked for.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
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

// Named points on the trade of speed for accuracy, from sweeps of `meniscal tradeoff` over scenes/: none of its knobs,
// turned from there, buys a much smaller error for the same CPU seconds on all of them.
enum class Quality { draft, preview, final };
struct PassCounts {
  std::uint32_t passes, photons, samples;  // the latter two of each pass
};
struct Preset {
  double photons_per_pixel;  // and pass
  std::uint32_t least_photons, passes;
  std::uint32_t plain_samples, gathering_samples;  // without and with final gathering, of one bounced path each
  std::uint32_t spark_samples;  // that look for highlights where a light is narrow: in menisci it shows as sparks
  bool final_gathering;
  bool fits_footprints;  // of photons to the view. Passes average noise, but not blur: not where many are to follow

  // Samples are cheap while a pass' photons are on the device at once: a picture so large that they would not be has
  // more passes, of as many fewer samples.
  PassCounts counts(std::size_t pixels, bool gathers) const {
    const double wanted = photons_per_pixel * double(pixels);
    const auto parts = static_cast<std::uint32_t>(std::max(std::ceil(wanted / kPhotonsAtOnce), 1.0));
    return {passes * parts, std::max(static_cast<std::uint32_t>(wanted / parts), least_photons),
            ((gathers ? gathering_samples : plain_samples) + parts - 1) / parts};
  }
};
constexpr Preset preset(Quality quality) {
  switch (quality) {
    case Quality::draft:
      return {0.64, 40000, 1, 1, 1, 16, false, true};
    case Quality::preview:
      return {1.6, 80000, 2, 2, 2, 36, false, true};
    case Quality::final:
      break;
  }
  return {3.2, 300000, 2, 4, 16, 64, true, false};
}

struct RenderOptions {
  std::string scene;
  std::string output;  // never empty after parsing: by default the scene's name with .exr, in the current folder

  std::string device = "auto";
  MeniscusModel meniscus = MeniscusModel::exact;
  double meniscus_tolerance = 1;
  Integrator integrator = Integrator::targeted;
  Quality quality = Quality::final;
  std::optional<std::uint32_t> photons;  // per pass; not given: the quality's
  std::optional<std::uint32_t> passes;   // not given: the range's, or no limit where there is another, or the quality's
  std::optional<double> time;            // of the whole process, seconds
  std::optional<double> target_error;    // estimated, relative
  std::optional<std::uint32_t> samples;  // camera rays a pixel and pass; not given: the quality's
  std::optional<std::uint32_t> highlight_samples;  // of a pixel that sees menisci; 0: as other camera rays find them
  std::optional<PassRange> pass_range;
  std::uint32_t kernel = shared::KERNEL_BIWEIGHT;
  std::optional<double> radius;  // of round footprints in pass 0, metres; not given: each photon has its own
  std::uint32_t diffuse_bounces = 8, specular_bounces = 16;
  std::optional<bool> final_gathering;  // not given: the quality's
  std::uint32_t seed = 0;
  MapScale map_scale;

  std::optional<Resolution> resolution;  // not given: default_width, and the camera's aspect
  std::optional<Crop> crop;              // lies within the resolution where both are given
  std::optional<std::string> camera;     // not given: the first

  std::optional<std::string> preview;  // PNG
  ToneMap tonemap = ToneMap::ward;
  std::optional<double> exposure;    // EV
  std::optional<std::string> stats;  // JSON
  std::optional<std::string> checkpoint;
  bool resume = false;            // from the checkpoint
  std::vector<std::string> aovs;  // of aov_names(), in that order, "all" resolved

  bool quiet = false, json_progress = false;

  static constexpr int default_width = 640;
  static constexpr std::uint32_t default_highlight_samples = 16;  // where all lights are wide

  // The passes to run of a crop of so many pixels: those of --pass-range below --passes. Never empty after parsing.
  PassRange passes_to_run(std::size_t pixels) const;
};

// Adds scene and options to the subcommand; `options` must outlive the parsing. Values that are wrong by themselves, or
// contradict each other, end it with a CLI::ParseError that names the option: exit code 2.
void add_render_options(CLI::App& command, RenderOptions& options);

// `--device`, `--resolution` and `--camera`, as every command has them that renders.
void add_view_options(CLI::App& command, RenderOptions& options, int default_width);
void add_progress_options(CLI::App& command, bool& quiet, bool& json);

// `--tonemap` and `--exposure`, as every command has them that shows pictures.
void add_tone_options(CLI::App& command, ToneMap& tonemap, std::optional<double>& exposure);

// `--meniscus` and `--meniscus-tolerance`, as every command has them that writes menisci.
void add_meniscus_options(CLI::App& command, MeniscusModel& model, double& tolerance);

}  // namespace meniscal

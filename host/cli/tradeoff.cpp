// meniscal tradeoff: what speed costs in accuracy on a scene, as a page.
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <set>

#include "host/cli/commands.h"
#include "host/cli/interrupt.h"
#include "host/cli/progress.h"
#include "host/cli/render_settings.h"
#include "host/cli/start_backend.h"
#include "host/cli/validators.h"
#include "host/cpu_seconds.h"
#include "host/error.h"
#include "host/image/atomic_file.h"
#include "host/render/statistics.h"
#include "host/stopwatch.h"
#include "host/tradeoff/pictures.h"
#include "host/tradeoff/report.h"

namespace meniscal {
namespace {

constexpr int kWidth = 320, kQuickWidth = 48;  // pixels

struct TradeoffOptions {
  RenderOptions common;       // scene, output, device, resolution, camera, tone mapping, progress
  std::uint32_t passes = 64;  // of the reference
  bool passes_given = false, quick = false;

  std::string csv() const { return std::filesystem::path(common.output).replace_extension(".csv").string(); }
};

// As `meniscal render` would take them: the settings in the report are what users may type.
RenderOptions parsed(const TradeoffOptions& options, const std::vector<std::string>& arguments) {
  RenderOptions parsed;
  CLI::App app;
  add_render_options(*app.add_subcommand("render"), parsed);
  std::vector<std::string> reversed = {"scene"};
  reversed.insert(reversed.end(), arguments.rbegin(), arguments.rend());
  reversed.push_back("render");
  app.parse(reversed);
  const RenderOptions& common = options.common;
  parsed.scene = common.scene, parsed.device = common.device;
  parsed.resolution = common.resolution, parsed.camera = common.camera;
  return parsed;
}

struct Rendered {
  Image image;
  double cpu_seconds = 0, wall_seconds = 0;
  double error_estimate = -1;
  RenderSettings settings;
  Backend::Statistics backend;
  bool menisci = false;
  std::vector<std::string> warnings;
};

// Everything from the loaded scene to the last pass, device and shaders included. Nothing once interrupted.
std::optional<Rendered> render(const RenderOptions& options, const Scene& scene, Progress* progress) {
  const Stopwatch wall;
  const double cpu = cpu_seconds();
  Rendered result;
  const World world = build_world(options, scene);
  for (const LiquidReport& l : world.liquids) result.menisci |= !l.contacts.empty();
  result.settings = choose_settings(options, scene, world);
  Film film(result.settings.crop, options.aovs, options.map_scale, scene.origin);
  {
    Stages stages;
    const std::unique_ptr<Backend> backend = start_backend(options, world, result.settings, stages);
    render_passes(*backend, options.passes_to_run(result.settings.crop.pixels()), film, [&](const Tallies&) {
      if (progress) progress->update(film.passes());
      return !interrupted();
    });
    result.backend = backend->statistics();
  }
  result.warnings = world.warnings;
  for (std::string& w : limits_hit(result.backend)) result.warnings.push_back(std::move(w));
  result.cpu_seconds = cpu_seconds() - cpu, result.wall_seconds = wall.seconds();
  if (interrupted()) return std::nullopt;
  result.error_estimate = film.error_estimate();
  result.image = film.image(result.settings.width, result.settings.height);
  return result;
}

// Converged in what the knobs turn at: other random numbers, finer menisci, more bounces, highlights in finer cells,
// which passes alone do not make up for.
std::vector<std::string> reference_arguments(std::uint32_t passes) {
  return {"--quality",
          "final",
          "--passes",
          std::to_string(passes),
          "--seed",
          "1",
          "--highlight-samples",
          "256",
          "--diffuse-bounces",
          "16",
          "--specular-bounces",
          "32",
          "--meniscus-tolerance",
          "0.25",
          "--aov",
          "targeted,caustic"};
}

std::string joined(const std::vector<std::string>& arguments) { return fmt::format("{}", fmt::join(arguments, " ")); }

std::vector<SweptPreset> swept_presets(const Scene& scene, std::size_t pixels) {
  std::vector<SweptPreset> presets;
  for (const auto& [name, quality] :
       {std::pair{"draft", Quality::draft}, {"preview", Quality::preview}, {"final", Quality::final}}) {
    const Preset p = preset(quality);
    RenderOptions usual;
    usual.quality = quality;
    const PassCounts counts = p.counts(pixels, p.final_gathering);
    presets.push_back({name, counts.photons, counts.passes, counts.samples, highlight_samples_of(usual, scene),
                       usual.diffuse_bounces, p.final_gathering});
  }
  return presets;
}

// Each once: menisci that fail at one tolerance and not at another matter here as anywhere.
class Warnings {
 public:
  void say(const std::vector<std::string>& warnings) {
    for (const std::string& w : warnings)
      if (said_.insert(w).second) fmt::print(stderr, "meniscal: warning: {}\n", w);
  }

 private:
  std::set<std::string> said_;
};

void measure(Report& report, const TradeoffOptions& options, const Scene& scene, const Reference& reference,
             Warnings& warnings, Progress& progress) {
  progress.begin("settings", static_cast<long>(report.sweep.settings.size()));
  for (const Setting& setting : report.sweep.settings) {
    const auto rendered = render(parsed(options, setting.arguments), scene, nullptr);
    if (!rendered) break;
    warnings.say(rendered->warnings);
    report.points.push_back(
        {setting, rendered->cpu_seconds, rendered->wall_seconds, reference.errors_of(rendered->image)});
    if (setting.knob == "preset")
      report.pictures.push_back({setting.preset, command_line(setting), report.points.size() - 1,
                                 reference.show(rendered->image), error_map(rendered->image, reference.image()),
                                 reference.flip_of(rendered->image).pixels});
    progress.update(static_cast<long>(report.points.size()));
  }
  progress.clear();
}

void write(const TradeoffOptions& options, const Report& report, const Reference& reference) {
  write_file(options.csv(), as_csv(report.points, report.clock));
  write_file(options.common.output, as_html(report, reference));
}

std::string summary(const Report& report, const std::string& output) {
  std::string text = fmt::format("{}: {} settings; {} beside it\n", output, report.points.size(), report.csv_name);
  for (const Advice& a : advice(report.points, report.clock, measures[0])) {
    const Point &own = report.points[a.preset], &best = report.points[a.best];
    text += fmt::format("{:<8} {:>8.3g} {}, {} {:.3g}", own.setting.preset, seconds_of(own, report.clock),
                        name_of(report.clock), measures[0].name, own.errors.image);
    if (a.best != a.preset) text += fmt::format("; {:.3g} times that of {}", a.ratio, command_line(best.setting));
    text += "\n";
  }
  return text;
}

void run(const TradeoffOptions& given) {
  TradeoffOptions options = given;
  RenderOptions& common = options.common;
  require_writable(common.output);
  require_writable(options.csv());
  // Shaders are compiled anew for every setting, as for who renders once; Mesa would find them in its files.
  ::setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
  catch_interrupts();
  Progress progress(progress_style(common.quiet, common.json_progress, isatty(STDERR_FILENO) != 0));

  const Scene scene = load_gltf(common.scene);
  Warnings warnings;
  warnings.say(scene.warnings);
  if (!common.resolution)
    common.resolution = size_of(find_camera(scene, common.camera), options.quick ? kQuickWidth : kWidth);
  if (options.quick && !options.passes_given) options.passes = 8;

  const std::vector<std::string> arguments = reference_arguments(options.passes);
  progress.begin("reference", options.passes);
  auto converged = render(parsed(options, arguments), scene, &progress);
  if (!converged) throw Error(ExitCode::interrupted, "interrupted before anything was measured; nothing is written");
  warnings.say(converged->warnings);
  const Reference reference(std::move(converged->image), common.tonemap, common.exposure);

  Report report;
  report.scene = std::filesystem::path(common.scene).filename().string();
  report.device = converged->backend.device_name, report.version = MENISCAL_VERSION;
  const bool on_cpu = common.device == "cpu" || converged->backend.device_type == "cpu";
  report.clock = on_cpu ? Clock::cpu : Clock::wall;
  report.reference_command = joined(arguments), report.reference_error = converged->error_estimate;
  report.csv_name = std::filesystem::path(options.csv()).filename().string();
  report.sweep = make_sweep(
      swept_presets(scene, converged->settings.crop.pixels()),
      {converged->menisci, converged->settings.highlights != shared::HIGHLIGHTS_NONE, converged->settings.footprint},
      options.quick);
  measure(report, options, scene, reference, warnings, progress);
  if (report.points.empty())
    throw Error(ExitCode::interrupted, "interrupted before anything was measured; nothing is written");
  write(options, report, reference);
  std::fputs(summary(report, common.output).c_str(), stdout);
  if (report.points.size() < report.sweep.settings.size())
    throw Error(ExitCode::interrupted, fmt::format("interrupted after {} of {} settings; {} holds these",
                                                   report.points.size(), report.sweep.settings.size(), common.output));
}

void require_own_names(const TradeoffOptions& options) {
  for (const std::string& name : {options.common.output, options.csv()})
    if (is_same_file(options.common.scene, name))
      throw CLI::ValidationError("--output", name + " is the scene itself: it would be lost");
}

}  // namespace

void add_tradeoff(CLI::App& app) {
  auto options = std::make_shared<TradeoffOptions>();
  RenderOptions& common = options->common;
  CLI::App* command = app.add_subcommand("tradeoff", "Measure what speed costs in accuracy on a scene");
  command->add_option("SCENE", common.scene, "glTF 2.0 scene, .gltf or .glb")->required();
  command->add_option("-o,--output", common.output, "Page to write; its table gets the same name with .csv")
      ->type_name("REPORT.html")
      ->required()
      ->check([](const std::string& name) {
        return name.ends_with(".html") ? std::string() : name + " does not end in .html";
      });
  add_view_options(*command, common, kWidth);
  CLI::Option* passes = command->add_option("--reference-passes", options->passes,
                                            "Passes of the reference, by final settings and another seed");
  passes->type_name("N")->transform(whole(1, most_passes))->capture_default_str();
  command->add_flag("--quick", options->quick, "A few settings in few pixels against a coarse reference, as a trial");
  add_tone_options(*command, common.tonemap, common.exposure);
  add_progress_options(*command, common.quiet, common.json_progress);
  command->parse_complete_callback([options, passes] {
    options->passes_given = passes->count() > 0;
    require_own_names(*options);
  });
  command->footer("Example: meniscal tradeoff scene.gltf -o scene.html --resolution 480x360");
  command->callback([options] { run(*options); });
}

}  // namespace meniscal

// meniscal render: from a scene to a picture. Reads as the pipeline.
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "host/cli/commands.h"
#include "host/cli/interrupt.h"
#include "host/cli/progress.h"
#include "host/cli/render_options.h"
#include "host/cli/render_settings.h"
#include "host/cli/start_backend.h"
#include "host/error.h"
#include "host/image/atomic_file.h"
#include "host/image/exr.h"
#include "host/image/png.h"
#include "host/render/checkpoint.h"
#include "host/render/header.h"
#include "host/render/statistics.h"
#include "host/stopwatch.h"

namespace meniscal {
namespace {

void require_outputs(const RenderOptions& options) {
  require_writable(options.output);
  if (options.preview) require_writable(*options.preview);
  if (options.stats) require_writable(*options.stats);
  if (options.checkpoint) require_writable(*options.checkpoint);
}

// Keeps the film now and then; a disk that is full in between is no reason to lose what is there.
class Keeper {
 public:
  Keeper(std::string file, Identity identity) : file_(std::move(file)), identity_(std::move(identity)) {}
  void keep(const Checkpoint& checkpoint, Film& film) const { save_checkpoint(file_, identity_, checkpoint, film); }
  void keep_now_and_then(const Checkpoint& checkpoint, Film& film) {
    if (kept_ && kept_->seconds() < 10) return;
    try {
      keep(checkpoint, film);
    } catch (const Error& error) {
      fmt::print(stderr, "meniscal: warning: {}\n", error.what());
    }
    kept_ = Stopwatch();
  }
  // Where to go on: empty without a file. It must hold the first of the passes asked for.
  Checkpoint resume(const PassRange& asked, Film& film) const {
    const Checkpoint found =
        load_checkpoint(file_, identity_, film).value_or(Checkpoint{{asked.first, asked.first}, {}, 0});
    if (found.passes.first != asked.first || found.passes.last > asked.last)
      throw Error(ExitCode::scene,
                  fmt::format("{}: it holds passes {}, which are not the first of {}; ask for other passes, or leave "
                              "--resume out to start anew",
                              file_, to_text({found.passes}), to_text({asked})));
    return found;
  }

 private:
  std::string file_;
  Identity identity_;
  std::optional<Stopwatch> kept_;
};

Identity identity_of_run(const RenderOptions& options, const Scene& scene, const RenderSettings& settings,
                         const Film& film) {
  Image frame = film.image(settings.width, settings.height);
  describe_settings(frame, scene, settings, options.meniscus, options.meniscus_tolerance, options.map_scale);
  return identity_of(frame);
}

// What the program still takes after the last pass, measured: 30 to 45 ns a number of the image to compress and write
// it, a tenth of a second to give memory and device back.
double seconds_to_end(const RenderOptions& options, const RenderSettings& settings) {
  return 0.1 + 45e-9 * double(settings.crop.pixels()) * 3 * double(1 + options.aovs.size());
}

void render(const RenderOptions& options) {
  const Stopwatch total;
  require_outputs(options);
  catch_interrupts();
  Progress progress(progress_style(options.quiet, options.json_progress, isatty(STDERR_FILENO) != 0));

  progress.begin("scene", 1);
  const Scene scene = load_gltf(options.scene);
  RunStatistics run;
  run.seconds["load"] = total.seconds();
  run.stages.add(scene.stages);
  const World world = build_world(options, scene);
  progress.clear();
  for (const std::string& w : scene.warnings) fmt::print(stderr, "meniscal: warning: {}\n", w);
  for (const std::string& w : world.warnings) fmt::print(stderr, "meniscal: warning: {}\n", w);
  RenderSettings settings = choose_settings(options, scene, world);

  const std::unique_ptr<Backend> backend = start_backend(options, world, settings, run.stages);
  Film film(settings.crop, options.aovs, options.map_scale, scene.origin);
  const PassRange asked = options.passes_to_run(settings.crop.pixels());
  Checkpoint so_far{{asked.first, asked.first}, {}, 0};
  std::optional<Keeper> keeper;
  if (options.checkpoint) keeper.emplace(*options.checkpoint, identity_of_run(options, scene, settings, film));
  if (options.resume) so_far = keeper->resume(asked, film);
  const double seconds_before = so_far.seconds;

  Stopping stopping(
      {asked, options.time, options.target_error}, [&] { return total.seconds(); }, seconds_to_end(options, settings));
  progress.begin("passes", stopping.expected_passes(film));
  std::optional<Stop> stop;
  if (film.passes() > 0) stop = stopping.reached(film);
  if (!stop)
    render_passes(
        *backend, {so_far.passes.last, asked.last}, film,
        [&](const Tallies& tallies) {
          so_far = {{asked.first, asked.first + film.passes()}, tallies, seconds_before + total.seconds()};
          if (keeper) keeper->keep_now_and_then(so_far, film);
          stopping.pass_ended();
          stop = interrupted() ? Stop::interrupt : stopping.reached(film);
          progress.expect(stopping.expected_passes(film));
          progress.update(film.passes());
          return !stop;
        },
        so_far.tallies);
  run.stop = stop.value_or(Stop::passes);
  run.tallies = so_far.tallies;
  run.passes = so_far.passes;
  run.error_estimate = film.error_estimate();
  run.backend = backend->statistics();
  for (const std::string& w : limits_hit(run.backend)) fmt::print(stderr, "meniscal: warning: {}\n", w);

  const Stopwatch writing;
  Image image = film.image(settings.width, settings.height);
  describe_settings(image, scene, settings, options.meniscus, options.meniscus_tolerance, options.map_scale);
  describe_passes(image, {run.passes}, seconds_before + total.seconds());
  write_exr(options.output, image);
  if (options.preview) write_preview(*options.preview, image, options.tonemap, options.exposure);
  run.seconds["write"] = writing.seconds();
  run.seconds["total"] = total.seconds();
  if (options.stats) write_file(*options.stats, statistics_json(world, settings, options.meniscus, run).dump(2) + "\n");
  if (keeper) keeper->keep(so_far, film);
  if (interrupted())
    throw Error(ExitCode::interrupted,
                fmt::format("interrupted after {} passes; {} holds the image so far", film.passes(), options.output));
}

}  // namespace

void add_render(CLI::App& app) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command = app.add_subcommand("render", "Render a scene to an OpenEXR image");
  add_render_options(*command, *options);
  command->footer("Example: meniscal render scene.gltf -o scene.exr --preview scene.png --target-error 0.01");
  command->callback([options] { render(*options); });
}

}  // namespace meniscal

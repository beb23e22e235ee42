#include "host/cli/render_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "host/cli/validators.h"

namespace meniscal {
namespace {

constexpr int kMaxSide = 65536;  // pixels; what is allocated is checked against memory later

// "a,b,c" -> {"a", "b", "c"}; an empty text is one empty part.
std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

[[noreturn]] void reject(const std::string& option, const std::string& value, const std::string& wanted) {
  throw CLI::ValidationError(option, fmt::format("{} is not {}", value.empty() ? "\"\"" : value, wanted));
}

// An option whose value `parse` turns into something, or rejects.
template <class Parse>
CLI::Option* add_parsed(CLI::App& command, const std::string& name, const std::string& type, const std::string& help,
                        Parse parse) {
  return command
      .add_option_function<std::string>(
          name, [=](const std::string& text) { parse(name, text); }, help)
      ->type_name(type);
}

// An option that takes one of a few words.
template <class Enum>
CLI::Option* add_choice(CLI::App& command, const std::string& name, Enum& target,
                        const std::vector<std::pair<std::string, Enum>>& choices, const std::string& help) {
  std::string words;
  for (const auto& [word, value] : choices) words += (words.empty() ? "" : "|") + word;
  return add_parsed(command, name, words, help, [=, &target](const std::string& option, const std::string& text) {
    const auto found =
        std::find_if(choices.begin(), choices.end(), [&](const auto& choice) { return choice.first == text; });
    if (found == choices.end()) reject(option, text, "one of " + words);
    target = found->second;
  });
}

Resolution parse_resolution(const std::string& option, const std::string& text) {
  const std::vector<std::string> parts = split(text, 'x');
  Resolution r;
  if (parts.size() != 2 || !parse_integer(parts[0], r.width) || !parse_integer(parts[1], r.height) ||
      std::min(r.width, r.height) < 1 || std::max(r.width, r.height) > kMaxSide)
    reject(option, text, fmt::format("WxH with 1 to {} pixels a side, such as 640x480", kMaxSide));
  return r;
}

Crop parse_crop(const std::string& option, const std::string& text) {
  const std::vector<std::string> parts = split(text, ',');
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  if (parts.size() != 4 || !parse_integer(parts[0], x0) || !parse_integer(parts[1], y0) ||
      !parse_integer(parts[2], x1) || !parse_integer(parts[3], y1) || x0 < 0 || y0 < 0 || x1 <= x0 || y1 <= y0)
    reject(option, text, "X0,Y0,X1,Y1 with 0 <= X0 < X1 and 0 <= Y0 < Y1, in pixels, X1 and Y1 not included");
  return {static_cast<std::uint32_t>(x0), static_cast<std::uint32_t>(y0), static_cast<std::uint32_t>(x1),
          static_cast<std::uint32_t>(y1)};
}

PassRange parse_pass_range(const std::string& option, const std::string& text) {
  const std::vector<std::string> parts = split(text, ':');
  int first = 0, last = 0;
  if (parts.size() != 2 || !parse_integer(parts[0], first) || !parse_integer(parts[1], last) || first < 0 ||
      last <= first)
    reject(option, text, "A:B with 0 <= A < B, B not included, such as 0:16");
  return {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last)};
}

MapScale parse_map_scale(const std::string& option, const std::string& text) {
  MapScale scale;
  for (const std::string& part : split(text, ',')) {
    const std::size_t equals = part.find('=');
    const std::string map = part.substr(0, equals);
    double* factor = map == "targeted"  ? &scale.targeted
                     : map == "caustic" ? &scale.caustic
                     : map == "global"  ? &scale.global
                                        : nullptr;
    if (!factor || equals == std::string::npos || !parse_number(part.substr(equals + 1), *factor) ||
        !std::isfinite(*factor) || *factor < 0)
      reject(option, part, "MAP=FACTOR with a MAP of targeted, caustic, global and a FACTOR of 0 or more");
  }
  return scale;
}

std::vector<std::string> parse_aovs(const std::string& option, const std::string& text) {
  if (text == "all") return aov_names();
  if (text == "none") return {};
  const std::vector<std::string> asked = split(text, ',');
  for (const std::string& name : asked)
    if (std::find(aov_names().begin(), aov_names().end(), name) == aov_names().end())
      reject(option, name, fmt::format("a layer; choose of {}, or all, or none", fmt::join(aov_names(), ",")));
  std::vector<std::string> ordered;
  for (const std::string& name : aov_names())
    if (std::find(asked.begin(), asked.end(), name) != asked.end()) ordered.push_back(name);
  return ordered;
}

void add_transport_options(CLI::App& command, RenderOptions& options) {
  add_meniscus_options(command, options.meniscus, options.meniscus_tolerance);
  add_choice<Integrator>(
      command, "--integrator", options.integrator,
      {{"targeted", Integrator::targeted}, {"ordinary", Integrator::ordinary}, {"path", Integrator::path}},
      "Photons from what the camera sees back to the lights; to compare with: ordinary photon "
      "mapping from the lights, or path tracing (with --device cpu; it sees caustics of area lights "
      "alone)")
      ->default_str("targeted");
  add_choice<Quality>(command, "--quality", options.quality,
                      {{"draft", Quality::draft}, {"preview", Quality::preview}, {"final", Quality::final}},
                      "How much to spend; the options below override")
      ->default_str("final");
  const auto by_quality = [](auto value) {
    return fmt::format("{}|{}|{} by quality", value(Quality::draft), value(Quality::preview), value(Quality::final));
  };
  command
      .add_option("--photons", options.photons, "Photons started per pass; by default so many a pixel, 1048576 at most")
      ->type_name("N")
      ->transform(whole(1, 1 << 30))
      ->default_str(by_quality([](Quality q) { return preset(q).photons_per_pixel; }));
  command.add_option("--passes", options.passes, "Passes to run at most")
      ->type_name("N")
      ->transform(whole(1, most_passes))
      ->default_str(by_quality([](Quality q) { return preset(q).passes; }) +
                    ", more of fewer samples where pixels ask for too many photons; no limit with --time or "
                    "--target-error");
  command.add_option("--time", options.time, "Ends the program after so long; a pass that would not fit is not begun")
      ->type_name("SECONDS")
      ->check(positive());
  command
      .add_option("--target-error", options.target_error,
                  "Stops once the image's relative error, estimated from at least 8 passes, is E")
      ->type_name("E")
      ->check(positive());
  command.add_option("--samples", options.samples, "Camera rays a pixel and pass: the more, the smoother edges are")
      ->type_name("N")
      ->transform(whole(1, 1 << 16))
      ->default_str(by_quality([](Quality q) { return preset(q).plain_samples; }) +
                    fmt::format(", {} with final gathering", preset(Quality::final).gathering_samples));
  command
      .add_option("--highlight-samples", options.highlight_samples,
                  "Rays a pixel and pass that look for lights in menisci, rounded to a square number; 0: no more than "
                  "other camera rays")
      ->type_name("N")
      ->transform(whole(0, 1 << 16))
      ->default_str(by_quality([](Quality q) { return preset(q).spark_samples; }) +
                    fmt::format(" where a light is narrow, else {}", RenderOptions::default_highlight_samples));
  add_parsed(
      command, "--pass-range", "A:B", "Only passes A <= i < B, for splitting over machines",
      [&](const std::string& name, const std::string& text) { options.pass_range = parse_pass_range(name, text); });
  command
      .add_option("--radius", options.radius, "Round footprints of that radius in pass 0, instead of each photon's own")
      ->type_name("METRES")
      ->check(positive());
  std::vector<std::pair<std::string, std::uint32_t>> kernels;
  for (std::uint32_t k = 0; k < kernel_names.size(); ++k) kernels.emplace_back(kernel_names[k], k);
  add_choice(command, "--kernel", options.kernel, kernels,
             "How photons spread over their footprints, of which flatter ones are as much smaller that they blur alike")
      ->default_str(kernel_names[options.kernel]);
  command
      .add_option("--diffuse-bounces", options.diffuse_bounces, "Diffuse bounces; 0: direct light and caustics only")
      ->type_name("N")
      ->transform(whole(0, 1000))
      ->capture_default_str();
  command
      .add_option("--specular-bounces", options.specular_bounces,
                  "Longest specular chain; longer ones are cut and counted")
      ->type_name("N")
      ->transform(whole(0, 1000))
      ->capture_default_str();
  add_parsed(command, "--final-gathering", "on|off",
             "Interreflection gathered by another bounce of camera paths, or shown as photons left it",
             [&](const std::string& name, const std::string& text) {
               if (text != "on" && text != "off") reject(name, text, "one of on|off");
               options.final_gathering = text == "on";
             })
      ->default_str("on for final");
  command.add_option("--seed", options.seed, "Seed of the random numbers")
      ->type_name("N")
      ->transform(whole(0, std::numeric_limits<std::uint32_t>::max()))
      ->capture_default_str();
  add_parsed(command, "--map-scale", "MAP=FACTOR,...",
             "Factors on the contributions of the maps targeted, caustic, global",
             [&](const std::string& name, const std::string& text) { options.map_scale = parse_map_scale(name, text); })
      ->default_str("targeted=1,caustic=1,global=1");
}

void add_output_options(CLI::App& command, RenderOptions& options) {
  add_parsed(command, "--crop", "X0,Y0,X1,Y1", "Only pixels X0 <= x < X1, Y0 <= y < Y1, from the upper left",
             [&](const std::string& name, const std::string& text) { options.crop = parse_crop(name, text); });
  command.add_option("-o,--output", options.output, "Image to write; by default SCENE's name in the current folder")
      ->type_name("OUT.exr");
  add_parsed(command, "--aov", "NAME,...|all|none",
             fmt::format("Layers to write beside the beauty: {}", fmt::join(aov_names(), ",")),
             [&](const std::string& name, const std::string& text) { options.aovs = parse_aovs(name, text); })
      ->default_str("none");
  command.add_option("--preview", options.preview, "Tone-mapped 8-bit picture to write too")->type_name("FILE.png");
  add_tone_options(command, options.tonemap, options.exposure);
  command.add_option("--stats", options.stats, "Statistics to write")->type_name("FILE.json");
  CLI::Option* checkpoint =
      command.add_option("--checkpoint", options.checkpoint, "Keeps the rendering so far, every 10 s and at the end");
  checkpoint->type_name("FILE");
  command.add_flag("--resume", options.resume, "Goes on from the checkpoint; without one, starts anew")
      ->needs(checkpoint);
  add_progress_options(command, options.quiet, options.json_progress);
}

// No output may take the place of another or of the scene.
void require_own_names(const RenderOptions& options) {
  std::vector<std::pair<std::string, std::string>> names = {{"SCENE", options.scene}, {"--output", options.output}};
  if (options.preview) names.emplace_back("--preview", *options.preview);
  if (options.stats) names.emplace_back("--stats", *options.stats);
  if (options.checkpoint) names.emplace_back("--checkpoint", *options.checkpoint);
  for (std::size_t j = 1; j < names.size(); ++j)
    for (std::size_t i = 0; i < j; ++i)
      if (is_same_file(names[i].second, names[j].second))
        throw CLI::ValidationError(names[j].first,
                                   fmt::format("{} is the file of {}, too", names[j].second, names[i].first));
}

// What only the options together can tell.
void finish(RenderOptions& options) {
  if (options.output.empty()) options.output = std::filesystem::path(options.scene).stem().string() + ".exr";
  require_own_names(options);
  const PassRange range = options.passes_to_run(1);
  if (range.last <= range.first)
    throw CLI::ValidationError(
        "--pass-range", fmt::format("begins at pass {}, but --passes ends before pass {}", range.first, range.last));
  if (options.crop && options.resolution &&
      (options.crop->x1 > static_cast<std::uint32_t>(options.resolution->width) ||
       options.crop->y1 > static_cast<std::uint32_t>(options.resolution->height)))
    throw CLI::ValidationError(
        "--crop", fmt::format("reaches to {},{}, beyond --resolution {}x{}", options.crop->x1, options.crop->y1,
                              options.resolution->width, options.resolution->height));
}

}  // namespace

PassRange RenderOptions::passes_to_run(std::size_t pixels) const {
  if (pass_range) return {pass_range->first, std::min(pass_range->last, passes.value_or(pass_range->last))};
  return {0, passes.value_or(time || target_error ? most_passes : preset(quality).counts(pixels, false).passes)};
}

void add_view_options(CLI::App& command, RenderOptions& options, int default_width) {
  command
      .add_option("--device", options.device,
                  "auto, cpu (the reference path), or a Vulkan device's index or part of its name")
      ->type_name("DEVICE")
      ->capture_default_str();
  add_parsed(
      command, "--resolution", "WxH",
      fmt::format("Pixels; by default {} wide, as high as the camera's aspect asks", default_width),
      [&](const std::string& name, const std::string& text) { options.resolution = parse_resolution(name, text); });
  command.add_option("--camera", options.camera, "Camera to look through; by default the scene's first")
      ->type_name("NAME");
}

void add_progress_options(CLI::App& command, bool& quiet, bool& json) {
  command.add_flag("--quiet", quiet, "No progress");
  command.add_flag("--json-progress", json, "Progress as JSON lines, as where standard error is no terminal")
      ->excludes("--quiet");
}

void add_tone_options(CLI::App& command, ToneMap& tonemap, std::optional<double>& exposure) {
  add_choice<ToneMap>(command, "--tonemap", tonemap,
                      {{"ward", ToneMap::ward}, {"aces", ToneMap::aces}, {"linear", ToneMap::linear}},
                      "Tone mapping of the preview; ward: contrast-based scale factor, as in the paper")
      ->default_str("ward");
  command.add_option("--exposure", exposure, "Brightens the preview by 2^EV")->type_name("EV")->check(finite());
}

void add_meniscus_options(CLI::App& command, MeniscusModel& model, double& tolerance) {
  add_choice<MeniscusModel>(
      command, "--meniscus", model,
      {{"none", MeniscusModel::none}, {"paper", MeniscusModel::paper}, {"exact", MeniscusModel::exact}},
      "No menisci, the paper's profile, or the Young-Laplace surface")
      ->default_str("exact");
  command
      .add_option("--meniscus-tolerance", tolerance,
                  "Factor on how far the facets of menisci may be off, 1 um on water and 0.036 degrees; pictures "
                  "also fit it to what they show")
      ->type_name("F")
      ->check(positive())
      ->capture_default_str();
}

void add_render_options(CLI::App& command, RenderOptions& options) {
  command.add_option("SCENE", options.scene, "glTF 2.0 scene, .gltf or .glb")->required();
  add_view_options(command, options, RenderOptions::default_width);
  add_transport_options(command, options);
  add_output_options(command, options);
  command.parse_complete_callback([&options] { finish(options); });
}

}  // namespace meniscal

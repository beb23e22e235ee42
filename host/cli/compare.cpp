// meniscal compare: how far two images are from each other.
#include "host/image/compare.h"

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "host/cli/commands.h"
#include "host/cli/validators.h"
#include "host/error.h"
#include "host/image/exr.h"

namespace meniscal {
namespace {

struct CompareOptions {
  std::string a, b;
  bool json = false;
  std::optional<double> max_rmse;
};

std::string shown_name(const LayerDifference& d) { return d.layer.empty() ? "beauty" : d.layer; }

std::string table(const std::vector<LayerDifference>& differences) {
  std::string text = fmt::format("{:<12} {:>10} {:>10} {:>10} {:>10}  {:<16} {:>10}\n", "layer", "rel. rmse", "rmse",
                                 "mean A/B", "max |A-B|", "at", "non-finite");
  for (const LayerDifference& d : differences)
    text += fmt::format("{:<12} {:>10.4g} {:>10.4g} {:>10.6g} {:>10.4g}  {:<16} {:>10}\n", shown_name(d),
                        d.relative_rmse, d.rmse, d.mean_ratio, d.max_difference,
                        fmt::format("{},{} {}", d.max_x, d.max_y, d.max_channel), d.non_finite);
  return text;
}

nlohmann::ordered_json as_json(const CompareOptions& options, const std::vector<LayerDifference>& differences) {
  nlohmann::ordered_json layers = nlohmann::ordered_json::array();
  for (const LayerDifference& d : differences)
    layers.push_back(
        {{"layer", shown_name(d)},
         {"channels", d.channels},
         {"relative_rmse", d.relative_rmse},
         {"rmse", d.rmse},
         {"mean_ratio", d.mean_ratio},
         {"max_difference", {{"value", d.max_difference}, {"x", d.max_x}, {"y", d.max_y}, {"channel", d.max_channel}}},
         {"samples", d.samples},
         {"non_finite", d.non_finite}});
  return {{"a", options.a}, {"b", options.b}, {"layers", layers}};
}

// A pixel that is not a number lies within no bound.
void require_within(const CompareOptions& options, const std::vector<LayerDifference>& differences) {
  for (const LayerDifference& d : differences) {
    if (d.non_finite > 0)
      throw Error(ExitCode::failed,
                  fmt::format("{} and {}: layer {} has {} values that are not finite; --max-rmse allows none",
                              options.a, options.b, shown_name(d), d.non_finite));
    if (!(d.relative_rmse <= *options.max_rmse))
      throw Error(ExitCode::failed,
                  fmt::format("{} and {}: layer {} differs by a relative RMSE of {:.4g}; --max-rmse allows {:.4g}",
                              options.a, options.b, shown_name(d), d.relative_rmse, *options.max_rmse));
  }
}

void run(const CompareOptions& options) {
  const Image a = read_exr(options.a), b = read_exr(options.b);
  const std::vector<LayerDifference> differences = compare(a, options.a, b, options.b);
  const std::string text = options.json ? as_json(options, differences).dump(2) + "\n" : table(differences);
  std::fputs(text.c_str(), stdout);
  if (options.max_rmse) require_within(options, differences);
}

}  // namespace

void add_compare(CLI::App& app) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App* command = app.add_subcommand("compare", "Say how far image A is from the reference B, layer by layer");
  command->add_option("A", options->a, "EXR image")->required();
  command->add_option("B", options->b, "EXR image, the reference")->required();
  command->add_flag("--json", options->json, "Print JSON");
  command
      ->add_option("--max-rmse", options->max_rmse,
                   "Exit with 1 where a layer's relative RMSE, rmse / rms(B), is above E")
      ->type_name("E")
      ->check(non_negative());
  command->footer("Example: meniscal compare picture.exr reference.exr --max-rmse 0.01");
  command->callback([options] { run(*options); });
}

}  // namespace meniscal

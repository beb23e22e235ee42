// meniscal merge: one picture of several that rendered passes of their own.
#include "host/render/merge.h"

#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "host/cli/commands.h"
#include "host/image/atomic_file.h"
#include "host/image/exr.h"

namespace meniscal {
namespace {

struct MergeOptions {
  std::vector<std::string> images;
  std::string output;
};

void run(const MergeOptions& options) {
  require_writable(options.output);
  Merge merge;
  for (const std::string& name : options.images) merge.add(read_exr(name), name);
  const Image image = merge.result();
  write_exr(options.output, image);
  fmt::print("{}: passes {} of {} images\n", options.output, image.text.at("passRange"), options.images.size());
}

}  // namespace

void add_merge(CLI::App& app) {
  auto options = std::make_shared<MergeOptions>();
  CLI::App* command = app.add_subcommand("merge", "Make one image of several that hold different passes");
  command->add_option("IMAGE", options->images, "EXR images, rendered with --pass-range or merged before")->required();
  command->add_option("-o,--output", options->output, "Image to write; may be one of those merged")
      ->type_name("OUT.exr")
      ->required();
  command->footer("Example: meniscal merge first.exr second.exr -o both.exr");
  command->callback([options] { run(*options); });
}

}  // namespace meniscal

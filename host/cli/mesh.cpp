// meniscal mesh: the scene with the menisci of its liquids, for any renderer that reads glTF.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>

#include "host/cli/commands.h"
#include "host/cli/render_options.h"
#include "host/cli/validators.h"
#include "host/error.h"
#include "host/export/container.h"
#include "host/export/export.h"
#include "host/image/atomic_file.h"

namespace meniscal {
namespace {

struct MeshOptions {
  std::string scene, output;
  MeniscusModel meniscus = MeniscusModel::exact;
  double tolerance = 1;
};

std::string summary(const std::string& file, const std::vector<LiquidSurface>& liquids) {
  std::size_t triangles = 0, menisci = 0, contacts = 0;
  for (const auto& [object, surface] : liquids) {
    triangles += surface.mesh.triangles.size();
    menisci += static_cast<std::size_t>(std::count(surface.meniscus.begin(), surface.meniscus.end(), 1));
    contacts += surface.contacts.size();
  }
  const auto counted = [](std::size_t count, const char* one, const char* more) {
    return fmt::format("{} {}", count, count == 1 ? one : more);
  };
  return fmt::format("{}: {} of {} triangles, {} of them in {}\n", file, counted(liquids.size(), "liquid", "liquids"),
                     triangles, menisci, counted(contacts, "meniscus", "menisci"));
}

std::string read_file(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// A glTF file holds no OpenEXR image: the environment lies beside the new file as beside the scene. What else has that
// name there is not ours to overwrite.
void copy_environment(const MeshOptions& options, const std::string& name) {
  namespace fs = std::filesystem;
  const auto beside = [&](const std::string& file) { return (fs::path(file).parent_path() / name).string(); };
  const std::string from = beside(options.scene), to = beside(options.output);
  if (is_same_file(from, to)) return;
  const std::string image = read_file(from);
  std::error_code error;  // of what is no folder: met when the file is written
  if (fs::exists(to, error)) {
    if (read_file(to) == image) return;
    throw Error(ExitCode::failed,
                to + ": is there, but is not the scene's environment: move it away, or write into another folder");
  }
  fs::create_directories(fs::path(to).parent_path(), error);
  write_file(to, image);
}

void run(const MeshOptions& options) {
  require_writable(options.output);
  gltf::Exported exported = gltf::export_with_menisci(options.scene, options.meniscus, options.tolerance);
  for (const std::string& w : exported.warnings) fmt::print(stderr, "meniscal: warning: {}\n", w);
  if (!exported.environment_file.empty()) copy_environment(options, exported.environment_file);
  const auto pack = options.output.ends_with(".glb") ? gltf::as_glb : gltf::as_text;
  write_file(options.output, pack(std::move(exported.document)));
  std::fputs(summary(options.output, exported.liquids).c_str(), stdout);
}

}  // namespace

void add_mesh(CLI::App& app) {
  auto options = std::make_shared<MeshOptions>();
  CLI::App* command = app.add_subcommand("mesh", "Write a scene with the menisci of its liquids, for any renderer");
  command->add_option("SCENE", options->scene, "glTF 2.0 scene, .gltf or .glb")->required();
  command
      ->add_option("-o,--output", options->output,
                   "Scene to write, .glb or .gltf: everything in one file, but an environment beside it")
      ->type_name("OUT")
      ->required()
      ->check([](const std::string& name) {
        const bool known = name.ends_with(".glb") || name.ends_with(".gltf");
        return known ? std::string() : name + " ends neither in .glb nor in .gltf";
      });
  add_meniscus_options(*command, options->meniscus, options->tolerance);
  command->parse_complete_callback([options] {
    if (is_same_file(options->scene, options->output))
      throw CLI::ValidationError("--output", options->output + " is the scene itself: its liquids would be lost");
  });
  command->footer("Example: meniscal mesh scene.gltf -o scene.glb");
  command->callback([options] { run(*options); });
}

}  // namespace meniscal

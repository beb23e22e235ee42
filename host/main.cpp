// Meniscal: caustics of liquid-solid menisci.
#include <CLI/CLI.hpp>

#include "host/cli/commands.h"
#include "host/cli/run.h"

int main(int argc, char** argv) {
  CLI::App app{"Renders glTF scenes with the menisci of their liquids, and the caustics these throw.", "meniscal"};
  app.set_version_flag("--version", "meniscal " MENISCAL_VERSION);
  app.require_subcommand(1);
  app.footer("Example: meniscal render scene.gltf --preview scene.png");

  meniscal::add_render(app);
  meniscal::add_info(app);
  meniscal::add_devices(app);
  meniscal::add_compare(app);

  return meniscal::run(app, argc, argv);
}

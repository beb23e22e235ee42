// Meniscal: caustics of liquid-solid menisci.
#include <CLI/CLI.hpp>

#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <csignal>

#include "host/cli/commands.h"
#include "host/cli/run.h"

int main(int argc, char** argv) {
#ifdef __GLIBC__
  // Memory that is given back to the system is cleared and mapped again at the next use: one twentieth of a short
  // render.
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
#endif
#ifdef SIGXFSZ
  // Files that may not grow (ulimit -f) are told of like a full disk, and nothing half-written stays.
  std::signal(SIGXFSZ, SIG_IGN);
#endif
  CLI::App app{"Renders glTF scenes with the menisci of their liquids, and the caustics these throw.", "meniscal"};
  app.set_version_flag("--version", "meniscal " MENISCAL_VERSION);
  app.require_subcommand(1);
  app.footer("Example: meniscal render scene.gltf --preview scene.png");

  meniscal::add_render(app);
  meniscal::add_info(app);
  meniscal::add_mesh(app);
  meniscal::add_devices(app);
  meniscal::add_merge(app);
  meniscal::add_compare(app);
  meniscal::add_tradeoff(app);

  return meniscal::run(app, argc, argv);
}

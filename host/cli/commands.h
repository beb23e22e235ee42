// The subcommands of `meniscal`, one file each. Each adds itself to the application, and runs when the command line
// names it.
#pragma once

#include <CLI/CLI.hpp>

namespace meniscal {

void add_render(CLI::App& app);
void add_info(CLI::App& app);
void add_mesh(CLI::App& app);
void add_devices(CLI::App& app);
void add_merge(CLI::App& app);
void add_compare(CLI::App& app);
void add_tradeoff(CLI::App& app);

}  // namespace meniscal

// From an exception to a message and an exit code.
#pragma once

#include <CLI/CLI.hpp>

namespace meniscal {

// Parses the command line and runs the subcommand it names. Returns the program's exit code (ExitCode): whatever goes
// wrong has then been said on standard error.
int run(CLI::App& app, int argc, const char* const* argv);

}  // namespace meniscal

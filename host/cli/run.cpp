#include "host/cli/run.h"

#include <fmt/format.h>

#include <cstdio>
#include <new>

#include "host/error.h"

namespace meniscal {
namespace {

int fail(ExitCode code, const std::string& message) {
  fmt::print(stderr, "meniscal: {}\n", message);
  return static_cast<int>(code);
}

// What was wrong, and where the right use stands.
std::string usage_message(const CLI::App& app, const CLI::ParseError& error) {
  const auto chosen = app.get_subcommands();
  if (!chosen.empty()) return fmt::format("{}; see meniscal {} --help", error.what(), chosen.front()->get_name());
  const std::vector<std::string> unknown = app.remaining();
  if (!unknown.empty()) return fmt::format("{} is no command of meniscal; see meniscal --help", unknown.front());
  return fmt::format("{}; see meniscal --help", error.what());
}

}  // namespace

int run(CLI::App& app, int argc, const char* const* argv) {
  try {
    app.parse(argc, argv);
    // Results that a full disk or a closed pipe swallowed are not done.
    if (std::fflush(stdout) != 0 || std::ferror(stdout))
      return fail(ExitCode::failed, "standard output cannot be written");
    return static_cast<int>(ExitCode::done);
  } catch (const CLI::Success& help_or_version) {
    return app.exit(help_or_version);
  } catch (const CLI::ParseError& error) {
    return fail(ExitCode::usage, usage_message(app, error));
  } catch (const Error& error) {
    return fail(error.code, error.what());
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::failed, "out of memory; render fewer pixels (--resolution) or photons (--photons)");
  } catch (const std::exception& error) {
    return fail(ExitCode::failed, error.what());
  }
}

}  // namespace meniscal

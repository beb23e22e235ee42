// Errors that end the program carry the exit code that interface promises; see `main`.
#pragma once

#include <stdexcept>
#include <string>

namespace meniscal {

enum class ExitCode : int { done = 0, failed = 1, usage = 2, scene = 3, device = 4, interrupted = 130 };

// The message names the file, the object in it, the reason and the remedy.
class Error : public std::runtime_error {
 public:
  Error(ExitCode exit_code, const std::string& message) : std::runtime_error(message), code(exit_code) {}
  const ExitCode code;
};

}  // namespace meniscal

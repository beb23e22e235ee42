// The built program, run as users run it.
#pragma once

#include <sys/wait.h>

#include <cstdlib>

#include "tests/unit/image_temporary_folder.h"

namespace meniscal::test {

struct Outcome {
  int code;  // -1: ended by a signal
  std::string output, error;
};

// `prefix`: of the shell's command, such as limits or variables.
inline Outcome meniscal(const TemporaryFolder& folder, const std::string& arguments, const std::string& prefix = "") {
  const std::string out = folder / "stdout", err = folder / "stderr";
  const std::string command = prefix + "\"" MENISCAL_PROGRAM "\" " + arguments + " >\"" + out + "\" 2>\"" + err + "\"";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_bytes(out), read_bytes(err)};
}

}  // namespace meniscal::test

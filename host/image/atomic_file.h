// Output files appear whole or not at all: they are written beside their place, then renamed.
#pragma once

#include <fstream>
#include <functional>
#include <string>

namespace meniscal {

// Lets `write` fill a file that then takes the place of `path` in one step; a symbolic link keeps pointing there. If
// anything fails, an existing `path` stays as it was and no trace remains. Devices and pipes (/dev/stdout) are written
// directly. Exceptions of `write` pass through; else throws Error(ExitCode::failed), naming the file and the system's
// reason.
void write_file(const std::string& path, const std::function<void(std::ofstream&)>& write);

// The same for bytes already in memory.
void write_file(const std::string& path, const std::string& bytes);

// Throws the error that `write_file` would meet at once (no such folder, no permission): to be asked before a long
// rendering.
void require_writable(const std::string& path);

}  // namespace meniscal

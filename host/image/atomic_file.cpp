#include "host/image/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "host/error.h"

namespace meniscal {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& reason, const std::string& remedy) {
  throw Error(ExitCode::failed, fmt::format("{}: cannot be written: {}; {}", path, reason, remedy));
}

[[noreturn]] void fail_with_errno(const std::string& path, int error) {
  const char* remedy = "choose another output file";
  if (error == ENOENT) remedy = "create the folder first";
  if (error == EACCES || error == EPERM || error == EROFS) remedy = "choose a folder that you may write to";
  if (error == ENOSPC || error == EFBIG || error == EDQUOT) remedy = "make room or choose another disk";
  fail(path, error != 0 ? std::strerror(error) : "input/output error", remedy);
}

std::ofstream open_for_writing(const fs::path& file, const std::string& shown) {
  errno = 0;
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  if (!stream) fail_with_errno(shown, errno);
  return stream;
}

void write_to(std::ofstream& stream, const std::string& shown, const std::function<void(std::ofstream&)>& write) {
  errno = 0;
  write(stream);
  stream.close();  // flushes; a full disk may show only here
  if (!stream) fail_with_errno(shown, errno);
}

// Without this a crash after the renaming may leave an empty file under the final name; late errors of network disks
// show here too.
void flush_to_disk(const fs::path& file, const std::string& shown) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail_with_errno(shown, errno);
  const int status = ::fsync(descriptor), error = errno;
  ::close(descriptor);
  if (status != 0) fail_with_errno(shown, error);
}

// Where the bytes are to end: what a symbolic link points to, so that renaming does not replace the link.
fs::path final_place(const std::string& path) {
  std::error_code error;
  const fs::path resolved = fs::weakly_canonical(path, error);
  return error ? fs::path(path) : resolved;
}

// A name of its own for each process: two renderings to one file do not mix.
fs::path place_beside(const fs::path& file) {
  return fs::path(fmt::format("{}.{}.partial", file.string(), ::getpid()));
}

// Removes the unfinished file unless it was renamed.
struct Partial {
  fs::path file;
  bool renamed = false;
  Partial(const Partial&) = delete;
  Partial& operator=(const Partial&) = delete;
  explicit Partial(fs::path place) : file(std::move(place)) {}
  ~Partial() {
    std::error_code ignored;
    if (!renamed) fs::remove(file, ignored);
  }
};

// True where renaming would replace a device or pipe by a file.
bool is_special(const fs::path& file, const std::string& shown) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (fs::is_directory(status)) fail(shown, "it is a folder", "give the name of a file in it");
  return fs::exists(status) && !fs::is_regular_file(status);
}

}  // namespace

void write_file(const std::string& path, const std::function<void(std::ofstream&)>& write) {
  if (path.empty()) fail("\"\"", "the name is empty", "give the name of a file");
  const fs::path place = final_place(path);
  if (is_special(place, path)) {
    std::ofstream stream = open_for_writing(path, path);
    return write_to(stream, path, write);
  }
  Partial partial(place_beside(place));
  std::ofstream stream = open_for_writing(partial.file, path);
  write_to(stream, path, write);
  flush_to_disk(partial.file, path);
  std::error_code error;
  fs::rename(partial.file, place, error);
  if (error) fail_with_errno(path, error.value());
  partial.renamed = true;
}

void write_file(const std::string& path, const std::string& bytes) {
  write_file(path,
             [&](std::ofstream& stream) { stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size())); });
}

void require_writable(const std::string& path) {
  if (path.empty()) fail("\"\"", "the name is empty", "give the name of a file");
  const fs::path place = final_place(path);
  if (is_special(place, path)) return;
  const Partial partial(place_beside(place));
  open_for_writing(partial.file, path);
}

}  // namespace meniscal

// Output files appear whole or not at all.
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

#include "gtest/gtest.h"
#include "host/error.h"
#include "host/image/atomic_file.h"
#include "host/image/exr.h"
#include "host/image/png.h"
#include "tests/unit/image_temporary_folder.h"

namespace meniscal {
namespace {

using test::read_bytes;
using test::TemporaryFolder;
using test::write_bytes;

// Files of this process cannot grow past `bytes` while this lives: a disk that is full, for root as well.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    rlimit now = before_;
    now.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &now);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

// The message of the Error that `action` throws, which must carry `code`.
template <class Action>
std::string error_of(ExitCode code, const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.code, code);
    return error.what();
  }
  ADD_FAILURE() << "no Error was thrown";
  return {};
}

Image noise(int size) {
  Image image;
  image.width = image.height = size;
  image.layers = {{"", {"R", "G", "B"}, std::vector<float>(3 * image.pixel_count())}};
  unsigned state = 1;
  for (float& v : image.layers[0].pixels) v = static_cast<float>(state = state * 1664525u + 1013904223u);
  return image;
}

TEST(File, IsWrittenAndReplaced) {
  const TemporaryFolder folder;
  write_file(folder / "a", "first");
  EXPECT_EQ(read_bytes(folder / "a"), "first");
  write_file(folder / "a", "second, longer");
  EXPECT_EQ(read_bytes(folder / "a"), "second, longer");
  EXPECT_EQ(folder.files(), 1u);
}

TEST(File, OfAMissingFolderNamesFileAndRemedy) {
  const TemporaryFolder folder;
  const std::string path = folder / "missing/a.json";
  const std::string message = error_of(ExitCode::failed, [&] { write_file(path, "x"); });
  EXPECT_NE(message.find(path), std::string::npos) << message;
  EXPECT_NE(message.find("create the folder"), std::string::npos) << message;
  EXPECT_EQ(message, error_of(ExitCode::failed, [&] { require_writable(path); }));
}

TEST(File, OfAnUnwritableFolderIsRefused) {
  if (::geteuid() == 0) {  // root may write anywhere but here
    error_of(ExitCode::failed, [] { write_file("/proc/meniscal.json", "x"); });
    error_of(ExitCode::failed, [] { require_writable("/proc/meniscal.json"); });
    return;
  }
  const TemporaryFolder folder;
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  const std::string message = error_of(ExitCode::failed, [&] { write_file(folder / "a", "x"); });
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
  EXPECT_NE(message.find("may write"), std::string::npos) << message;
  EXPECT_EQ(folder.files(), 0u);
}

TEST(File, ThatIsAFolderIsRefused) {
  const TemporaryFolder folder;
  const std::string message = error_of(ExitCode::failed, [&] { write_file(folder.path(), "x"); });
  EXPECT_NE(message.find("is a folder"), std::string::npos) << message;
}

TEST(File, StaysAsItWasWhenTheWriterThrows) {
  const TemporaryFolder folder;
  write_bytes(folder / "a", "before");
  const auto write = [](std::ofstream& stream) {
    stream << "half";
    throw std::runtime_error("stopped");
  };
  EXPECT_THROW(write_file(folder / "a", write), std::runtime_error);
  EXPECT_EQ(read_bytes(folder / "a"), "before");
  EXPECT_EQ(folder.files(), 1u);
}

TEST(File, StaysAsItWasWhenTheDiskIsFull) {
  const TemporaryFolder folder;
  const std::vector<std::uint8_t> noisy = tone_map(noise(128).layers[0].pixels, ToneMap::linear, {});
  const std::vector<std::pair<std::string, std::function<void(const std::string&)>>> writers{
      {"json", [](const std::string& path) { write_file(path, std::string(100000, 'x')); }},
      {"exr", [](const std::string& path) { write_exr(path, noise(128)); }},
      {"png", [&](const std::string& path) { write_png(path, 128, 128, noisy); }},
  };
  for (const auto& [name, write] : writers) {
    const std::string path = folder / name;
    write_bytes(path, "before");
    std::string message;
    {
      const FullDisk full(4096);
      message = error_of(ExitCode::failed, [&, &w = write] { w(path); });
    }
    EXPECT_NE(message.find(path), std::string::npos) << message;
    EXPECT_NE(message.find("make room"), std::string::npos) << message;
    EXPECT_EQ(read_bytes(path), "before") << name;
    EXPECT_NO_THROW(write(path)) << name;
    EXPECT_GT(read_bytes(path).size(), 4096u) << name;
  }
  EXPECT_EQ(folder.files(), writers.size());
}

TEST(File, KeepsSymbolicLinks) {
  const TemporaryFolder folder;
  write_bytes(folder / "real", "before");
  std::filesystem::create_symlink("real", folder / "link");
  write_file(folder / "link", "after");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(read_bytes(folder / "real"), "after");
}

// A pipe stands for /dev/stdout and /dev/null, which a wrong program run by root would replace by a file.
TEST(File, NeverReplacesAPipeOrDevice) {
  const TemporaryFolder folder;
  const std::string path = folder / "pipe";
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  const int reader = ::open(path.c_str(), O_RDWR | O_NONBLOCK);
  require_writable(path);
  write_file(path, "bytes");
  char read[8] = {};
  EXPECT_EQ(::read(reader, read, sizeof read), 5);
  ::close(reader);
  EXPECT_STREQ(read, "bytes");
  EXPECT_TRUE(std::filesystem::is_fifo(path));
  EXPECT_EQ(folder.files(), 1u);
}

TEST(File, RequireWritableLeavesNothingAndKeepsWhatIsThere) {
  const TemporaryFolder folder;
  require_writable(folder / "new");
  EXPECT_EQ(folder.files(), 0u);
  write_bytes(folder / "old", "kept");
  require_writable(folder / "old");
  EXPECT_EQ(read_bytes(folder / "old"), "kept");
  EXPECT_EQ(folder.files(), 1u);
}

}  // namespace
}  // namespace meniscal

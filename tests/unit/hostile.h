// Files that mean harm, given to the program as a user would, within 10 s and 1 GiB.
#pragma once

#include <algorithm>
#include <chrono>

#include "gtest/gtest.h"
#include "tests/unit/program.h"

#ifdef __has_feature  // clang
#define SANITIZED __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#else
#define SANITIZED __SANITIZE_ADDRESS__ || __SANITIZE_THREAD__
#endif

namespace meniscal::test {

// `command` of the program, then the file's name (twice for `compare`): exit code 3 and one line that names the file
// and each of `parts`.
inline void expect_refused(const TemporaryFolder& folder, const std::string& name, const std::string& bytes,
                           const std::vector<std::string>& parts, const std::string& command = "info") {
  const std::string path = folder / name;
  write_bytes(path, bytes);
  const std::string quoted = " \"" + path + "\"";
  const auto start = std::chrono::steady_clock::now();
#if SANITIZED  // which reserves terabytes of addresses
  const std::string limits = "timeout 60 ";
#else
  const std::string limits = "ulimit -v 1048576; timeout 10 ";
#endif
  const Outcome o = meniscal(folder, command + quoted + (command == "compare" ? quoted : ""), limits);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  EXPECT_EQ(o.code, 3) << name << " after " << seconds.count() << " s: " << o.error;
  EXPECT_EQ(std::count(o.error.begin(), o.error.end(), '\n'), 1) << name << ": " << o.error;
  EXPECT_TRUE(o.output.empty()) << name << ": " << o.output;
  EXPECT_NE(o.error.find(path), std::string::npos) << name << ": " << o.error;
  for (const std::string& part : parts) EXPECT_NE(o.error.find(part), std::string::npos) << name << ": " << o.error;
}

// The first `sixteenths` sixteenths of it.
inline std::string cut(const std::string& bytes, std::size_t sixteenths) {
  return bytes.substr(0, bytes.size() * sixteenths / 16);
}

}  // namespace meniscal::test

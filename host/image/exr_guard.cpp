#include "host/image/exr_guard.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

namespace meniscal {
namespace {

std::uint32_t word(std::istream& file) {  // little-endian
  std::array<unsigned char, 4> b{};
  file.read(reinterpret_cast<char*>(b.data()), b.size());
  return std::uint32_t{b[0]} | std::uint32_t{b[1]} << 8 | std::uint32_t{b[2]} << 16 | std::uint32_t{b[3]} << 24;
}

std::string name(std::istream& file) {
  std::string result;
  std::getline(file, result, '\0');
  return result;
}

// For a terminal.
std::string shown(std::string text) {
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 32 || c == 127; };
  std::replace_if(text.begin(), text.end(), is_control, '?');
  return text.substr(0, 60);
}

// Name, type, size and value, again and again, until a name is empty. False where there was none at all.
bool walk_header(std::istream& file, std::uint64_t file_bytes) {
  bool any = false;
  for (std::string attribute; !(attribute = name(file)).empty(); any = true) {
    name(file);  // of its type
    const std::uint64_t size = word(file);
    if (!file) break;
    const auto at = static_cast<std::uint64_t>(file.tellg());
    if (size > file_bytes - std::min(at, file_bytes))
      throw std::runtime_error(
          fmt::format("its attribute \"{}\" claims {} bytes, the file has {}", shown(attribute), size, file_bytes));
    file.seekg(static_cast<std::streamoff>(size), std::ios::cur);
  }
  return any && file;
}

}  // namespace

void require_attributes_within(std::istream& file, std::uint64_t file_bytes) {
  constexpr std::uint32_t multi_part = 0x1000;
  const auto start = file.tellg();
  word(file);  // the magic number
  const bool many = (word(file) & multi_part) != 0;
  while (walk_header(file, file_bytes) && many) {
  }
  file.clear();
  file.seekg(start);
}

}  // namespace meniscal

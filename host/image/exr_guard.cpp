#include "host/image/exr_guard.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
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

// Bytes of the values that are all as long, by type (OpenEXR file layout, "Attribute types"). OpenEXR reads so many
// whatever the header says, and would find the next attribute elsewhere than is looked for it here.
const std::map<std::string, std::uint64_t, std::less<>> fixed_sizes = {
    {"box2i", 16},      {"box2f", 16},   {"chromaticities", 32},
    {"compression", 1}, {"double", 8},   {"envmap", 1},
    {"float", 4},       {"int", 4},      {"keycode", 28},
    {"lineOrder", 1},   {"m33f", 36},    {"m33d", 72},
    {"m44f", 64},       {"m44d", 128},   {"rational", 8},
    {"tiledesc", 9},    {"timecode", 8}, {"v2i", 8},
    {"v2f", 8},         {"v2d", 16},     {"v3i", 12},
    {"v3f", 12},        {"v3d", 24},     {"deepImageState", 1}};

// How long a value at the stream's place says that it is; nothing where only the header says so.
std::optional<std::uint64_t> own_size(std::istream& file, const std::string& type, std::uint64_t size) {
  if (const auto fixed = fixed_sizes.find(type); fixed != fixed_sizes.end()) return fixed->second;
  std::uint64_t own = 0;
  if (type == "chlist") {
    for (std::string channel; !(channel = name(file)).empty() && file; own += channel.size() + 17) file.ignore(16);
    return own + 1;
  }
  if (type == "preview") {
    const std::uint64_t width = word(file), height = word(file);
    return height != 0 && width > size / height ? size + 1 : 8 + 4 * width * height;
  }
  if (type == "stringvector") {
    while (own < size && file) {
      const std::uint64_t length = word(file);
      own += 4 + length;
      file.ignore(static_cast<std::streamsize>(length));
    }
    return own;
  }
  return std::nullopt;
}

// Name, type, size and value, again and again, until a name is empty. False where there was none at all.
bool walk_header(std::istream& file, std::uint64_t file_bytes) {
  bool any = false;
  for (std::string attribute; !(attribute = name(file)).empty(); any = true) {
    const std::string type = name(file);
    const std::uint64_t size = word(file);
    if (!file) break;
    const auto at = file.tellg();
    if (size > file_bytes - std::min(static_cast<std::uint64_t>(at), file_bytes))
      throw std::runtime_error(
          fmt::format("its attribute \"{}\" claims {} bytes, the file has {}", shown(attribute), size, file_bytes));
    const std::uint64_t own = own_size(file, type, size).value_or(size);
    if (own != size)
      throw std::runtime_error(
          fmt::format("its attribute \"{}\" is of {} bytes, not the {} that are claimed", shown(attribute), own, size));
    file.clear();
    file.seekg(at + static_cast<std::streamoff>(size));
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

#include "host/scene/guard.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>

#include "host/scene/embedded.h"

namespace meniscal::gltf {
namespace fs = std::filesystem;

AssetFolder::AssetFolder(const std::string& scene_path, const Messages& messages)
    : scene_(scene_path), messages_(messages) {
  std::error_code error;
  const fs::path parent = scene_.has_parent_path() ? scene_.parent_path() : fs::path(".");
  root_ = fs::canonical(parent, error);
  if (error) messages.fail("scene file", error.message(), "check the path");
}

std::vector<unsigned char> AssetFolder::read_scene() { return read(scene_, "scene file"); }

std::vector<unsigned char> AssetFolder::read_beside(const std::string& uri) {
  return read(resolve(uri), fmt::format("uri \"{}\"", uri));
}

fs::path AssetFolder::resolve(const std::string& uri) const {
  const std::string object = fmt::format("uri \"{}\"", uri);
  const fs::path relative(uri);
  const bool leaves = relative.has_root_path() || uri.find('\0') != std::string::npos ||
                      std::find(relative.begin(), relative.end(), "..") != relative.end();
  std::error_code error;
  // Symbolic links are followed before the comparison: they may lead out, too.
  const fs::path target = leaves ? fs::path() : fs::weakly_canonical(root_ / relative, error);
  const auto [rest, ignored] = std::mismatch(root_.begin(), root_.end(), target.begin(), target.end());
  if (leaves || (!error && rest != root_.end()))
    messages_.fail(object, "leads out of the scene's folder", "put the file beside the scene and name it relatively");
  return error ? root_ / relative : target;
}

std::vector<unsigned char> AssetFolder::read(const fs::path& path, std::string_view object) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) messages_.fail(object, "no such file", "check the path");
  // Opening a folder aborts tinygltf's reader, opening a pipe waits for ever.
  if (!fs::is_regular_file(status)) messages_.fail(object, "is not a plain file", "name a file");
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) messages_.fail(object, error.message(), "check the file's permissions");
  if (size > max_bytes - bytes_read_)
    messages_.fail(object,
                   fmt::format("has {} bytes, more than the {} left to this scene", size, max_bytes - bytes_read_),
                   "split or simplify the scene");
  std::vector<unsigned char> bytes(size);
  std::ifstream stream(path, std::ios::binary);
  if (!stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
    messages_.fail(object, "cannot be read", "check the file's permissions");
  bytes_read_ += size;
  for (const unsigned char byte : bytes) hash_ = (hash_ ^ byte) * 0x100000001b3u;
  return bytes;
}

std::vector<unsigned char>* AssetFolder::embedded(const std::string& uri) {
  for (std::size_t i = 0; i < embedded_.size(); ++i)
    if (uri == embedded_name(i)) return &embedded_[i];
  return nullptr;
}

tinygltf::FsCallbacks AssetFolder::callbacks() {
  tinygltf::FsCallbacks result{};
  result.user_data = this;
  result.ExpandFilePath = [](const std::string& uri, void*) { return uri; };
  result.FileExists = [](const std::string& uri, void* self) {
    auto* folder = static_cast<AssetFolder*>(self);
    std::error_code error;
    return folder->embedded(uri) != nullptr || fs::exists(folder->resolve(uri), error);
  };
  result.ReadWholeFile = [](std::vector<unsigned char>* out, std::string*, const std::string& uri, void* self) {
    auto* folder = static_cast<AssetFolder*>(self);
    if (auto* buffer = folder->embedded(uri)) {
      *out = std::move(*buffer);
      return true;
    }
    *out = folder->read_beside(uri);
    return true;
  };
  result.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
  };
  return result;
}

std::string AssetFolder::hash() const { return fmt::format("{:016x}", hash_); }

bool is_binary(const std::vector<unsigned char>& file) {
  return file.size() >= 4 && std::memcmp(file.data(), "glTF", 4) == 0;
}

std::string_view json_text(const std::vector<unsigned char>& file, const Messages& messages) {
  const std::string_view all(reinterpret_cast<const char*>(file.data()), file.size());
  if (!is_binary(file)) return all;

  const auto word = [&](std::uint64_t offset) {  // little-endian
    return std::uint32_t{file[offset]} | std::uint32_t{file[offset + 1]} << 8 | std::uint32_t{file[offset + 2]} << 16 |
           std::uint32_t{file[offset + 3]} << 24;
  };
  constexpr std::uint32_t json_chunk = 0x4e4f534a, bin_chunk = 0x004e4942;
  const auto broken = [&](std::string_view reason) {
    messages.fail("GLB container", reason, "export the scene again, the file is damaged");
  };
  // tinygltf trusts the second chunk's length to within 8 bytes past the end: every chunk is checked here.
  if (file.size() < 20) broken("is shorter than its header");
  if (word(4) != 2) broken(fmt::format("has version {}, not 2", word(4)));
  const std::uint64_t length = word(8), json_length = word(12);
  if (length > file.size()) broken(fmt::format("states {} bytes, the file has {}", length, file.size()));
  if (word(16) != json_chunk || json_length > length - std::min<std::uint64_t>(length, 20))
    broken("does not begin with a JSON chunk that fits the file");
  const std::uint64_t bin = 20 + json_length;
  if (bin % 4 != 0) broken("has a JSON chunk whose length is no multiple of 4");
  if (bin != length && (length - bin < 8 || word(bin) > length - bin - 8 || word(bin + 4) != bin_chunk))
    broken("has a second chunk that is not a BIN chunk or does not fit the file");
  return all.substr(20, json_length);
}

void check_depth(std::string_view json, const Messages& messages) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      if (++depth > max_json_depth)
        messages.fail("JSON", fmt::format("nests deeper than {} levels", max_json_depth),
                      "remove the deep value (it is probably in `extras`)");
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
}

}  // namespace meniscal::gltf

// The door for bytes: what a scene file may make this program read, and how much of it.
// tinygltf 2.7 itself follows `../../etc/passwd`, aborts on folders and overflows its stack on deep JSON.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "host/scene/messages.h"

namespace meniscal::gltf {

// tinygltf keeps offsets and indices as int: no file may need more, nor all the files of a scene together.
inline constexpr std::uint64_t max_bytes = (std::uint64_t{1} << 31) - 1;
// Real files are about 10 deep; tinygltf recurses once a level.
inline constexpr int max_json_depth = 64;

// Reads files of the scene's own folder and of no other, and hashes what was read.
class AssetFolder {
 public:
  AssetFolder(const std::string& scene_path, const Messages& messages);

  // The scene file itself.
  std::vector<unsigned char> read_scene();

  // A file that the scene names.
  std::vector<unsigned char> read_beside(const std::string& uri);

  // The buffers taken out of the scene file's text: tinygltf will ask for each once, by its embedded_name.
  void add_embedded(std::vector<std::vector<unsigned char>> buffers) { embedded_ = std::move(buffers); }

  // File access for tinygltf, to be used with an empty base folder so that paths arrive as the file states them.
  // Throws Error for a path that leaves the folder (by name or by symbolic link), is no plain file or is too large.
  tinygltf::FsCallbacks callbacks();

  // FNV-1a, 64 bits, of all bytes read so far, as 16 hexadecimal digits.
  std::string hash() const;

 private:
  std::filesystem::path resolve(const std::string& uri) const;
  std::vector<unsigned char> read(const std::filesystem::path& path, std::string_view object);
  std::vector<unsigned char>* embedded(const std::string& uri);  // null: a file's name

  std::filesystem::path scene_, root_;
  std::vector<std::vector<unsigned char>> embedded_;
  const Messages& messages_;
  std::uint64_t bytes_read_ = 0;
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

// The JSON text: the whole of a .gltf, the first chunk of a .glb whose header and chunks fit the file.
std::string_view json_text(const std::vector<unsigned char>& file, const Messages& messages);

bool is_binary(const std::vector<unsigned char>& file);

// Fails where arrays and objects nest deeper than max_json_depth. Does not recurse.
void check_depth(std::string_view json, const Messages& messages);

}  // namespace meniscal::gltf

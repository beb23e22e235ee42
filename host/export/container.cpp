#include "host/export/container.h"

#include <cstdint>
#include <limits>

#include "host/base64.h"
#include "host/error.h"

namespace meniscal::gltf {
namespace {

void append_word(std::string& bytes, std::uint32_t word) {  // little-endian
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(word >> shift & 0xff);
}

void append_chunk(std::string& bytes, std::uint32_t type, const std::string& content) {
  append_word(bytes, static_cast<std::uint32_t>(content.size()));
  append_word(bytes, type);
  bytes += content;
}

}  // namespace

std::string as_glb(Document document) {
  constexpr std::uint32_t magic = 0x46546c67, version = 2, json_chunk = 0x4e4f534a, bin_chunk = 0x004e4942;
  document.bytes.resize((document.bytes.size() + 3) / 4 * 4, '\0');
  if (!document.bytes.empty()) document.json["buffers"] = {{{"byteLength", document.bytes.size()}}};
  std::string json = document.json.dump();
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::size_t length = 12 + 8 + json.size() + (document.bytes.empty() ? 0 : 8 + document.bytes.size());
  if (length > std::numeric_limits<std::uint32_t>::max())
    throw Error(ExitCode::failed, "the scene is larger than the 4 GiB that a .glb holds; split it");
  std::string file;
  file.reserve(length);
  append_word(file, magic);
  append_word(file, version);
  append_word(file, static_cast<std::uint32_t>(length));
  append_chunk(file, json_chunk, json);
  if (!document.bytes.empty()) append_chunk(file, bin_chunk, document.bytes);
  return file;
}

std::string as_text(Document document) {
  if (!document.bytes.empty())
    document.json["buffers"] = {{{"byteLength", document.bytes.size()},
                                 {"uri", "data:application/octet-stream;base64," + base64(document.bytes)}}};
  return document.json.dump(1) + "\n";
}

}  // namespace meniscal::gltf

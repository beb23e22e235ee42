// Buffers that stand as base64 in the text of a .gltf itself (data URIs).
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace meniscal::gltf {

struct Embedded {
  std::string json;                                 // the text, with embedded_name(i) where buffers[i] stood
  std::vector<std::vector<unsigned char>> buffers;  // decoded
};

// The URI that stands for a buffer taken out of the text.
std::string embedded_name(std::size_t index);

// Takes them out before anyone parses the text: JSON parsers copy strings character by character, and there are two of
// them (schema.h, tinygltf). What is not well-formed base64 of a buffer's media type stays, for those to refuse.
Embedded take_out_buffers(std::string_view json);

}  // namespace meniscal::gltf

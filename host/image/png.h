// PNG previews.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/image/layers.h"
#include "host/image/tonemap.h"

namespace meniscal {

// Interleaved 8-bit sRGB, the top row first, 3 * width * height bytes, as the bytes of a file; `name` is for messages.
// Throws Error(ExitCode::failed).
std::string encode_png(const std::string& name, int width, int height, const std::vector<std::uint8_t>& rgb);

// Writes the same.
void write_png(const std::string& path, int width, int height, const std::vector<std::uint8_t>& rgb);

// Tone maps the beauty (which must have channels R, G, B) and writes it. Throws Error(ExitCode::failed).
void write_preview(const std::string& path, const Image& image, ToneMap operation, std::optional<double> exposure);

}  // namespace meniscal

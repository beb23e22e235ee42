#include "host/image/png.h"

#include <fmt/format.h>
#include <png.h>

#include "host/error.h"
#include "host/image/atomic_file.h"

namespace meniscal {

std::string encode_png(const std::string& name, int width, int height, const std::vector<std::uint8_t>& rgb) {
  if (width <= 0 || height <= 0 ||
      rgb.size() != std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
    throw Error(ExitCode::failed,
                fmt::format("{}: {} bytes are not {} x {} RGB pixels", name, rgb.size(), width, height));
  png_image header{};  // libpng's simplified interface: 8-bit samples are sRGB, errors come back as values
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(width);
  header.height = static_cast<png_uint_32>(height);
  header.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::string bytes(size, '\0');
  if (!png_image_write_to_memory(&header, bytes.data(), &size, 0, rgb.data(), 0, nullptr))
    throw Error(ExitCode::failed, fmt::format("{}: cannot be encoded: {}", name, header.message));
  bytes.resize(size);
  return bytes;
}

void write_png(const std::string& path, int width, int height, const std::vector<std::uint8_t>& rgb) {
  write_file(path, encode_png(path, width, height, rgb));
}

void write_preview(const std::string& path, const Image& image, ToneMap operation, std::optional<double> exposure) {
  const Layer* beauty = image.find("");
  if (!beauty || beauty->channels != std::vector<std::string>{"R", "G", "B"})
    throw Error(ExitCode::failed, path + ": a preview needs channels R, G, B");
  write_png(path, image.width, image.height, tone_map(beauty->pixels, operation, exposure));
}

}  // namespace meniscal

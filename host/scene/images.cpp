#include "host/scene/images.h"

#include <fmt/format.h>
#include <stb_image.h>

#include <cstring>
#include <span>
#include <string_view>

namespace meniscal::gltf {
namespace {

std::span<const unsigned char> file_of(const tinygltf::Model& model, const tinygltf::Image& image) {
  if (image.bufferView < 0) return image.image;
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(image.bufferView)];
  return std::span(model.buffers[static_cast<std::size_t>(view.buffer)].data).subspan(view.byteOffset, view.byteLength);
}

bool is_known_kind(std::span<const unsigned char> file) {
  const std::string_view bytes(reinterpret_cast<const char*>(file.data()), file.size());
  return bytes.starts_with("\x89PNG") || bytes.starts_with("\xff\xd8\xff");
}

// Whether no chunk of a PNG claims more bytes than the file has left: stb_image makes room for what one claims.
bool has_its_chunks(std::span<const unsigned char> file) {
  for (std::size_t at = 8; at + 8 <= file.size();) {
    const std::size_t claimed = std::size_t{file[at]} << 24 | std::size_t{file[at + 1]} << 16 |
                                std::size_t{file[at + 2]} << 8 | std::size_t{file[at + 3]};
    if (claimed > file.size() - at - 8) return false;
    if (std::memcmp(&file[at + 4], "IEND", 4) == 0) break;
    at += 12 + claimed;
  }
  return true;
}

// A byte stands for at most 8 x 8 texels a bit of a JPEG, and for 1032 bytes of 1 bit a texel of a PNG.
constexpr std::uint64_t greatest_expansion = 1032 * 8;

}  // namespace

std::shared_ptr<const TextureImage> Images::decode(std::size_t index) {
  if (decoded_[index]) return decoded_[index];
  const Stopwatch watch;
  const tinygltf::Image& source = model_.images[index];
  const std::string object = label("image", source.name.empty() ? source.uri : source.name, index);
  const std::span<const unsigned char> file = file_of(model_, source);
  if (file.empty()) messages_.fail(object, "no such file, or an empty one", "check the path");
  if (!is_known_kind(file)) messages_.fail(object, "is neither PNG nor JPEG", "export it as one of these");

  const auto size = static_cast<int>(file.size());  // below max_bytes
  const auto check = [&](bool decoded, std::string_view reason) {
    if (!decoded) messages_.fail(object, fmt::format("cannot be decoded: {}", reason), "save the image again");
  };
  check(file[0] == 0xff || has_its_chunks(file), "a part of it claims more bytes than the file has");
  int width = 0, height = 0, channels = 0;
  check(stbi_info_from_memory(file.data(), size, &width, &height, &channels) != 0,
        "it is damaged or has a billion texels and more");
  const std::uint64_t texels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  if (texels > max_texels - texels_)
    messages_.fail(
        object,
        fmt::format("has {} x {} texels, more than the {} left to this scene", width, height, max_texels - texels_),
        "use smaller images");
  // Before there is room made for them.
  check(texels <= greatest_expansion * file.size(),
        fmt::format("it claims {} x {} texels, which its {} bytes cannot hold", width, height, file.size()));
  if (texels_ + texels > free_texels + texels_per_byte * (bytes_ + file.size()))
    messages_.fail(object,
                   fmt::format("brings the scene's images to {} texels, over {} for each byte of their files",
                               texels_ + texels, texels_per_byte),
                   "make images of few colours smaller");

  TextureImage image{.name = source.name.empty() ? source.uri : source.name};
  image.width = static_cast<std::uint32_t>(width);
  image.height = static_cast<std::uint32_t>(height);
  image.deep = stbi_is_16_bit_from_memory(file.data(), size) != 0;
  void* decoded = nullptr;  // four channels, grey in red, green and blue alike
  if (image.deep)
    decoded = stbi_load_16_from_memory(file.data(), size, &width, &height, &channels, 4);
  else
    decoded = stbi_load_from_memory(file.data(), size, &width, &height, &channels, 4);
  check(decoded != nullptr, "it is damaged, its end is missing, or it needs more memory than there is");
  image.words.resize(texels * (image.deep ? 2 : 1));
  std::memcpy(image.words.data(), decoded, 4 * image.words.size());  // hosts are little-endian, as Vulkan's are
  stbi_image_free(decoded);
  texels_ += texels, bytes_ += file.size();
  stages_.add("images", watch.seconds());
  return decoded_[index] = std::make_shared<const TextureImage>(std::move(image));
}

}  // namespace meniscal::gltf

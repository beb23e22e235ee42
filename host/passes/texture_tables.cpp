#include "host/passes/texture_tables.h"

#include <algorithm>
#include <cstring>
#include <map>

#include "host/error.h"

namespace meniscal::passes {
namespace {

using Texel = glm::uvec4;
static_assert(sizeof(shared::MaterialTextures) == 2 * sizeof(Texel) && sizeof(shared::Texture) == 3 * sizeof(Texel) &&
              sizeof(CornerCoordinates) == 3 * sizeof(Texel));

std::uint32_t wrap_bits(Wrap wrap) {
  return wrap == Wrap::repeat ? shared::WRAP_REPEAT : wrap == Wrap::clamp ? shared::WRAP_CLAMP : shared::WRAP_MIRROR;
}

shared::Texture pack(const Texture& texture, std::uint32_t first) {
  shared::Texture packed{};
  packed.s = glm::vec3(texture.row[0]);
  packed.t = glm::vec3(texture.row[1]);
  packed.first = first;
  packed.width = texture.image->width;
  packed.height = texture.image->height;
  packed.reading = (texture.image->deep ? shared::READS_DEEP : 0) | (texture.nearest ? shared::READS_NEAREST : 0) |
                   (texture.set == 1 ? shared::READS_SECOND_SET : 0) |
                   wrap_bits(texture.wrap_s) << shared::WRAP_S_SHIFT |
                   wrap_bits(texture.wrap_t) << shared::WRAP_T_SHIFT;
  return packed;
}

// The images of the world's textures, each with the word where it begins.
std::map<const TextureImage*, std::size_t> place_images(const World& world, std::size_t& words) {
  std::map<const TextureImage*, std::size_t> first;
  for (const Texture& texture : world.textures)
    if (first.try_emplace(texture.image.get(), words).second) words += texture.image->words.size();
  if (words > 0xFFFFFFFFu) throw Error(ExitCode::scene, "the scene's images take more than 16 GiB; use smaller ones");
  return first;
}

template <class T>
void append(std::vector<Texel>& texels, const std::vector<T>& items) {
  const std::size_t begin = texels.size();
  texels.resize(begin + items.size() * sizeof(T) / sizeof(Texel));
  if (!items.empty()) std::memcpy(texels.data() + begin, items.data(), items.size() * sizeof(T));
}

std::uint32_t first_texture(const World& world) { return 2 * static_cast<std::uint32_t>(world.textured.size()); }

std::vector<Texel> texels_of(const World& world) {
  std::size_t words = 0;
  const auto first = place_images(world, words);
  std::vector<shared::MaterialTextures> materials = world.textured;
  for (shared::MaterialTextures& m : materials)
    for (std::uint32_t* texture : {&m.base, &m.metallic_roughness, &m.normal, &m.emissive})
      if (*texture != 0) *texture = first_texture(world) + 3 * (*texture - 1);
  std::vector<shared::Texture> textures;
  for (const Texture& texture : world.textures)
    textures.push_back(pack(texture, static_cast<std::uint32_t>(first.at(texture.image.get()))));
  std::vector<Texel> texels;
  append(texels, materials);
  append(texels, textures);
  append(texels, world.coordinates);
  return texels;
}

std::uint32_t kinds_of(const World& world) {
  std::uint32_t kinds = 0;
  for (const shared::MaterialTextures& m : world.textured)
    kinds |= (m.base != 0 ? shared::TEXTURE_BASE : 0) |
             (m.metallic_roughness != 0 ? shared::TEXTURE_METALLIC_ROUGHNESS : 0) |
             (m.normal != 0 ? shared::TEXTURE_NORMAL : 0) | (m.emissive != 0 ? shared::TEXTURE_EMISSIVE : 0);
  for (const Texture& texture : world.textures) kinds |= texture.image->deep ? shared::TEXTURE_DEEP : 0;
  return kinds;
}

gpu::Buffer upload_images(const gpu::Device& device, const World& world) {
  std::size_t words = 0;
  const auto first = place_images(world, words);
  gpu::Buffer buffer(device, "images", 4 * words);
  for (const auto& [image, word] : first) buffer.upload(image->words, 4 * word);
  return buffer;
}

gpu::Buffer upload_textures(const gpu::Device& device, const World& world) {
  const std::vector<Texel> texels = texels_of(world);
  gpu::Buffer buffer(device, "textures", texels.size() * sizeof(Texel));
  buffer.upload(texels);
  return buffer;
}

}  // namespace

TextureTables::TextureTables(const gpu::Device& device, const World& world)
    : textures(upload_textures(device, world)),
      images(upload_images(device, world)),
      kinds(kinds_of(world)),
      first_coordinates(first_texture(world) + 3 * static_cast<std::uint32_t>(world.textures.size())) {}

}  // namespace meniscal::passes

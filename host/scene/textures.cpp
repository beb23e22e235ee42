#include "host/scene/textures.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "host/scene/validate.h"

namespace meniscal::gltf {
namespace {

// What textureInfo, normalTextureInfo and their extensions have in common.
struct Reference {
  std::string key;  // as in the file
  int index, set;
  const tinygltf::ExtensionMap& extensions;
};

template <class Info>
Reference reference(std::string key, const Info& info) {
  return {std::move(key), info.index, info.texCoord, info.extensions};
}

Wrap wrap(int mode, const std::string& object, const Messages& messages) {
  switch (mode) {
    case TINYGLTF_TEXTURE_WRAP_REPEAT:
      return Wrap::repeat;
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
      return Wrap::clamp;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
      return Wrap::mirror;
    default:
      messages.fail(object, fmt::format("has wrap mode {}", mode), "use 10497, 33071 or 33648");
  }
}

// Offset * rotation * scale; rotation goes counter-clockwise where y points down.
void transform(Texture& texture, int& set, const tinygltf::Value& values, const std::string& object,
               const Messages& messages) {
  const auto number = [&](const tinygltf::Value& value, const char* key) {
    if (!value.IsNumber() || !std::isfinite(value.GetNumberAsDouble()))
      messages.fail(object, fmt::format("{} is no number", key), "export the scene again");
    return value.GetNumberAsDouble();
  };
  const auto pair = [&](const char* key, glm::dvec2 absent) {
    if (!values.Has(key)) return absent;
    const tinygltf::Value& value = values.Get(key);
    if (!value.IsArray() || value.ArrayLen() != 2)
      messages.fail(object, fmt::format("{} is not two numbers", key), "export the scene again");
    return glm::dvec2(number(value.Get(0), key), number(value.Get(1), key));
  };
  const glm::dvec2 offset = pair("offset", glm::dvec2(0)), scale = pair("scale", glm::dvec2(1));
  const double angle = values.Has("rotation") ? number(values.Get("rotation"), "rotation") : 0;
  const double c = std::cos(angle), s = std::sin(angle);
  texture.row = {glm::dvec3(c * scale.x, s * scale.y, offset.x), glm::dvec3(-s * scale.x, c * scale.y, offset.y)};
  if (values.Has("texCoord")) set = values.Get("texCoord").GetNumberAsInt();
}

std::optional<Texture> read_texture(const tinygltf::Model& model, const Reference& source, bool srgb,
                                    const std::string& object, Images& images, Messages& messages) {
  if (source.index < 0) return std::nullopt;
  const tinygltf::Texture& file = model.textures[static_cast<std::size_t>(source.index)];
  Texture texture{.srgb = srgb};
  int set = source.set;
  if (const auto found = source.extensions.find("KHR_texture_transform"); found != source.extensions.end())
    transform(texture, set, found->second, fmt::format("{}, {}", object, source.key), messages);
  const auto leave_out = [&](const std::string& why) {
    messages.warn(object, fmt::format("{} {}: its factor alone counts", source.key, why));
    return std::nullopt;
  };
  if (set < 0 || set > 1) return leave_out(fmt::format("reads TEXCOORD_{}, of which only 0 and 1 are known", set));
  if (file.source < 0) return leave_out("has no image that this loader knows");
  texture.set = set;
  if (file.sampler >= 0) {
    const auto index = static_cast<std::size_t>(file.sampler);
    const tinygltf::Sampler& sampler = model.samplers[index];
    const std::string name = label("sampler", sampler.name, index);
    texture.wrap_s = wrap(sampler.wrapS, name, messages);
    texture.wrap_t = wrap(sampler.wrapT, name, messages);
    texture.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
  }
  texture.image = images.decode(static_cast<std::size_t>(file.source));
  return texture;
}

// The largest green and blue of an image's texels, in [0, 1].
glm::dvec2 largest(const TextureImage& image) {
  glm::uvec2 most(0);
  if (image.deep)
    for (std::size_t i = 0; i < image.words.size(); i += 2)
      most = glm::max(most, glm::uvec2(image.words[i] >> 16, image.words[i + 1] & 0xFFFFu));
  else
    for (const std::uint32_t word : image.words)
      most = glm::max(most, glm::uvec2(word >> 8 & 0xFFu, word >> 16 & 0xFFu));
  return glm::dvec2(most) / (image.deep ? 65535.0 : 255.0);
}

// Of the extensions that are known but for their textures.
void warn_of_extensions(const tinygltf::Material& source, const std::string& object, Messages& messages) {
  std::vector<std::string> ignored;
  for (const auto& [name, extension] : source.extensions)
    if (is_supported(name))
      for (const std::string& key : extension.Keys())
        if (key.ends_with("Texture")) ignored.push_back(key);
  if (!ignored.empty())
    messages.warn(object, fmt::format("ignored, as if they were white: {}", fmt::join(ignored, ", ")));
}

}  // namespace

void read_textures(const tinygltf::Model& model, const tinygltf::Material& source, const std::string& object,
                   Images& images, Material& material, Messages& messages) {
  const auto& pbr = source.pbrMetallicRoughness;
  const Reference base = reference("baseColorTexture", pbr.baseColorTexture),
                  metallic_roughness = reference("metallicRoughnessTexture", pbr.metallicRoughnessTexture),
                  normal = reference("normalTexture", source.normalTexture),
                  emissive = reference("emissiveTexture", source.emissiveTexture);
  warn_of_extensions(source, object, messages);
  if (material.liquid) {
    for (const Reference* texture : {&base, &metallic_roughness, &normal, &emissive})
      if (texture->index >= 0)
        messages.warn(object,
                      fmt::format("{} is ignored: a liquid's surface has no texture coordinates", texture->key));
    return;
  }
  const auto read = [&](const Reference& texture, bool srgb) {
    return read_texture(model, texture, srgb, object, images, messages);
  };
  material.base_color_texture = read(base, true);
  material.metallic_roughness_texture = read(metallic_roughness, false);
  material.normal_texture = read(normal, false);
  if (material.emission != glm::dvec3(0)) material.emissive_texture = read(emissive, true);
  material.normal_scale = source.normalTexture.scale;
  if (material.metallic_roughness_texture) {
    const glm::dvec2 most = largest(*material.metallic_roughness_texture->image);
    material.most_roughness = most.x;
    material.most_metallic = most.y;
  }
}

bool reads_set(const Material& material, int set) {
  const auto reads = [&](const std::optional<Texture>& texture) { return texture && texture->set == set; };
  return reads(material.base_color_texture) || reads(material.metallic_roughness_texture) ||
         reads(material.normal_texture) || reads(material.emissive_texture);
}

}  // namespace meniscal::gltf

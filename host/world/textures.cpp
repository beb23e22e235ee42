#include "host/world/textures.h"

#include <algorithm>
#include <cmath>

#include "host/world/surfaces.h"

namespace meniscal {
namespace {

// IEC 61966-2-1.
double linear(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

// Of texels numbered without end: the one of 0 .. size - 1 that stands there.
std::uint32_t wrapped(double index, std::uint32_t size, Wrap wrap) {
  const double n = size;
  double i = index;
  if (wrap == Wrap::repeat) i -= n * std::floor(i / n);
  if (wrap == Wrap::mirror) {
    i -= 2 * n * std::floor(i / (2 * n));
    i = std::min(i, 2 * n - 1 - i);
  }
  return static_cast<std::uint32_t>(std::clamp(i, 0.0, n - 1));
}

glm::dvec4 texel(const Texture& texture, double x, double y) {
  const TextureImage& image = *texture.image;
  const std::size_t i =
      std::size_t{wrapped(y, image.height, texture.wrap_t)} * image.width + wrapped(x, image.width, texture.wrap_s);
  glm::dvec4 color;
  for (int c = 0; c < 4; ++c)
    color[c] = image.deep ? (image.words[2 * i + c / 2] >> 16 * (c % 2) & 0xFFFFu) / 65535.0
                          : (image.words[i] >> 8 * c & 0xFFu) / 255.0;
  if (texture.srgb)
    for (int c = 0; c < 3; ++c) color[c] = linear(color[c]);
  return color;
}

// Place in the table world.textures + 1; 0: none.
std::uint32_t add(World& world, const std::optional<Texture>& texture) {
  if (!texture) return 0;
  world.textures.push_back(*texture);
  return static_cast<std::uint32_t>(world.textures.size());
}

// Over the triangle with these coordinates: at the centres of n^2 equal ones.
glm::dvec3 mean(const Texture& texture, const CornerCoordinates& at, int n) {
  glm::dvec3 sum(0);
  const glm::dvec4 a(at[0]), ab = glm::dvec4(at[1]) - a, ac = glm::dvec4(at[2]) - a;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 2 * (n - i) - 1; ++j) {
      const double third = j % 2 == 0 ? 1.0 / 3 : 2.0 / 3;
      sum += glm::dvec3(look_up(texture, a + (i + third) / n * ab + (j / 2 + third) / n * ac));
    }
  return sum / double(n * n);
}

// Of the longest edge, in texels.
double texels_along(const Texture& texture, const CornerCoordinates& at) {
  const glm::dvec2 size(texture.image->width, texture.image->height);
  double most = 0;
  for (int k = 0; k < 3; ++k) {
    const glm::dvec4 edge = glm::dvec4(at[(k + 1) % 3]) - glm::dvec4(at[k]);
    const glm::dvec3 step = texture.set == 0 ? glm::dvec3(edge.x, edge.y, 0) : glm::dvec3(edge.z, edge.w, 0);
    most =
        std::max(most, glm::length(size * glm::dvec2(glm::dot(texture.row[0], step), glm::dot(texture.row[1], step))));
  }
  return most;
}

}  // namespace

glm::dvec4 look_up(const Texture& texture, const glm::dvec4& coordinates) {
  const glm::dvec3 at =
      texture.set == 0 ? glm::dvec3(coordinates.x, coordinates.y, 1) : glm::dvec3(coordinates.z, coordinates.w, 1);
  const double x = glm::dot(texture.row[0], at) * texture.image->width,
               y = glm::dot(texture.row[1], at) * texture.image->height;
  if (texture.nearest) return texel(texture, std::floor(x), std::floor(y));
  // Texels' centres lie at halves.
  const double left = std::floor(x - 0.5), top = std::floor(y - 0.5), s = x - 0.5 - left, t = y - 0.5 - top;
  return (1 - t) * ((1 - s) * texel(texture, left, top) + s * texel(texture, left + 1, top)) +
         t * ((1 - s) * texel(texture, left, top + 1) + s * texel(texture, left + 1, top + 1));
}

std::uint32_t add_textures(World& world, const Material& m) {
  if (!has_textures(m)) return 0;
  shared::MaterialTextures textures{};
  textures.base = add(world, m.base_color_texture);
  textures.metallic_roughness = add(world, m.metallic_roughness_texture);
  textures.normal = add(world, m.normal_texture);
  textures.emissive = add(world, m.emissive_texture);
  textures.metallic = static_cast<float>(m.metallic);
  textures.roughness = static_cast<float>(m.roughness);
  textures.least_roughness = static_cast<float>(specular_roughness);
  textures.normal_scale = static_cast<float>(m.normal_scale);
  world.textured.push_back(textures);
  return static_cast<std::uint32_t>(world.textured.size());
}

std::vector<glm::dvec3> mean_emission_factors(const World& world) {
  const auto texture_of = [&](const WorldTriangle& t) -> const Texture* {
    const shared::Surface& surface = world.surfaces[t.material];
    if (surface.textures == 0) return nullptr;
    const std::uint32_t emissive = world.textured[surface.textures - 1].emissive;
    return emissive == 0 ? nullptr : &world.textures[emissive - 1];
  };
  const auto count = std::count_if(world.triangles.begin(), world.triangles.end(),
                                   [&](const WorldTriangle& t) { return texture_of(t) != nullptr; });
  if (count == 0) return {};
  // Places half a texel apart miss none; so many in all take about a second.
  constexpr double most_places = 1 << 24;
  const double most = std::clamp(std::sqrt(most_places / static_cast<double>(count)), 8.0, 1024.0);
  std::vector<glm::dvec3> means;
  means.reserve(world.triangles.size());
  for (const WorldTriangle& t : world.triangles) {
    const Texture* texture = texture_of(t);
    means.emplace_back(1);
    if (!texture) continue;
    const CornerCoordinates at = t.coordinates == 0 ? CornerCoordinates{} : world.coordinates[t.coordinates - 1];
    means.back() = mean(*texture, at, static_cast<int>(std::clamp(2 * texels_along(*texture, at), 8.0, most)));
  }
  return means;
}

}  // namespace meniscal

#include "host/reference/materials.h"

#include <cmath>

#include "host/world/textures.h"

namespace meniscal::reference {
namespace {

// Barycentric weights of a point of the triangle.
glm::dvec3 weights_of(const WorldTriangle& t, const glm::dvec3& point) {
  glm::dvec3 weights;
  for (int k = 0; k < 3; ++k) {
    const glm::dvec3 &next = t.corner[(k + 1) % 3], &last = t.corner[(k + 2) % 3];
    weights[k] = glm::dot(t.geometric, glm::cross(last - next, point - next)) / (2 * t.area);
  }
  return weights;
}

// Texture coordinates of the triangle's corners; (0, 0) where it has none.
std::array<glm::dvec4, 3> corner_coordinates(const World& world, const WorldTriangle& t) {
  std::array<glm::dvec4, 3> corners{};
  if (t.coordinates != 0)
    for (int k = 0; k < 3; ++k) corners[k] = glm::dvec4(world.coordinates[t.coordinates - 1][k]);
  return corners;
}

glm::dvec4 interpolate(const std::array<glm::dvec4, 3>& corners, const glm::dvec3& weights) {
  return weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
}

const Texture* texture_at(const World& world, std::uint32_t index) {
  return index == 0 ? nullptr : &world.textures[index - 1];
}

// Place in the image, without wrapping.
glm::dvec2 image_place(const Texture& texture, const glm::dvec4& coordinates) {
  const glm::dvec2 at = texture.set == 0 ? glm::dvec2(coordinates) : glm::dvec2(coordinates.z, coordinates.w);
  return {glm::dot(texture.row[0], glm::dvec3(at, 1)), glm::dot(texture.row[1], glm::dvec3(at, 1))};
}

// The shading normal turned to where the texture's image has it: its red to the image's right, its green upwards. A
// triangle whose coordinates tell neither keeps its normal. No normal lies in the facet or below it.
glm::dvec3 bent_normal(const WorldTriangle& t, const Texture& texture, const std::array<glm::dvec4, 3>& corners,
                       const glm::dvec3& told, const glm::dvec3& shading) {
  // Gradients of the place over the facet: corner k's weight grows by (normal x opposite edge) / (2 area).
  glm::dvec3 right(0), down(0);
  for (int k = 0; k < 3; ++k) {
    const glm::dvec3 grows = glm::cross(t.geometric, t.corner[(k + 2) % 3] - t.corner[(k + 1) % 3]) / (2 * t.area);
    const glm::dvec2 place = image_place(texture, corners[k]);
    right += place.x * grows;
    down += place.y * grows;
  }
  // Along `tangent` the place moves to the image's right alone.
  glm::dvec3 tangent = glm::cross(down, t.geometric);
  const double orientation = glm::dot(tangent, right);
  if (orientation < 0) tangent = -tangent;
  tangent -= shading * glm::dot(shading, tangent);
  if (orientation == 0 || !(glm::length(tangent) > 0) || !(glm::dot(told, told) > 1e-12)) return shading;
  tangent = glm::normalize(tangent);
  glm::dvec3 up = glm::cross(shading, tangent);
  // Unmirrored, right and down turn clockwise as seen from outside.
  if (glm::dot(glm::cross(right, down), t.geometric) > 0) up = -up;
  const glm::dvec3 normal = glm::normalize(told.x * tangent + told.y * up + told.z * shading);
  const double lacks = double(shared::LEAST_BENT_COSINE) - glm::dot(normal, t.geometric);
  return glm::normalize(normal + std::max(lacks, 0.0) * t.geometric);
}

}  // namespace

shared::Surface shade(const World& world, Hit& hit) {
  const WorldTriangle& triangle = world.triangles[hit.triangle];
  shared::Surface surface = world.surfaces[triangle.material];
  if (surface.textures == 0) return surface;
  const shared::MaterialTextures& textures = world.textured[surface.textures - 1];
  const std::array<glm::dvec4, 3> corners = corner_coordinates(world, triangle);
  const glm::dvec4 at = interpolate(corners, weights_of(triangle, hit.point));

  glm::dvec3 base(surface.albedo);
  double metallic = double(textures.metallic), roughness = double(textures.roughness);
  if (const Texture* texture = texture_at(world, textures.base)) base *= glm::dvec3(look_up(*texture, at));
  if (const Texture* texture = texture_at(world, textures.metallic_roughness)) {
    const glm::dvec4 told = look_up(*texture, at);
    roughness *= told.y;
    metallic *= told.z;
  }
  if (const Texture* texture = texture_at(world, textures.emissive))
    surface.emission = glm::vec3(glm::dvec3(surface.emission) * glm::dvec3(look_up(*texture, at)));
  if (const Texture* texture = texture_at(world, textures.normal)) {
    const double scale = double(textures.normal_scale);
    const glm::dvec3 told = (2.0 * glm::dvec3(look_up(*texture, at)) - 1.0) * glm::dvec3(scale, scale, 1);
    hit.shading = bent_normal(triangle, *texture, corners, told, hit.shading);
  }
  return shared::textured(surface, glm::vec3(base), static_cast<float>(metallic),
                          std::max(static_cast<float>(roughness), textures.least_roughness));
}

glm::dvec3 emitted_part(const World& world, std::uint32_t triangle, const glm::dvec3& point) {
  const WorldTriangle& t = world.triangles[triangle];
  const shared::Surface& surface = world.surfaces[t.material];
  if (surface.textures == 0) return glm::dvec3(1);
  const Texture* texture = texture_at(world, world.textured[surface.textures - 1].emissive);
  return texture ? glm::dvec3(look_up(*texture, interpolate(corner_coordinates(world, t), weights_of(t, point))))
                 : glm::dvec3(1);
}

}  // namespace meniscal::reference

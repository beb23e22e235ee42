// Scenes with textures, as values.
#pragma once

#include "tests/support/scene_setup.h"

namespace meniscal::test {

template <class Texel>  // (x, y) -> red, green, blue, alpha in [0, 255], or 65535 where it is deep
std::shared_ptr<const TextureImage> make_image(std::uint32_t width, std::uint32_t height, bool deep, Texel texel) {
  TextureImage image;
  image.width = width;
  image.height = height;
  image.deep = deep;
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      const glm::uvec4 c = texel(x, y);
      image.words.push_back(deep ? c.x | c.y << 16 : c.x | c.y << 8 | c.z << 16 | c.w << 24);
      if (deep) image.words.push_back(c.z | c.w << 16);
    }
  return std::make_shared<const TextureImage>(std::move(image));
}

inline Texture make_texture(std::shared_ptr<const TextureImage> image, bool srgb, bool nearest = false) {
  Texture texture;
  texture.image = std::move(image);
  texture.srgb = srgb;
  texture.nearest = nearest;
  return texture;
}

// A rectangle that shows an image upright to those before it: `right` and `down` are its edges, (0, 0) is at `corner`.
inline Object make_quad(const std::string& name, const glm::dvec3& corner, const glm::dvec3& right,
                        const glm::dvec3& down, int material) {
  Object quad;
  quad.name = name;
  quad.mesh.positions = {corner, corner + right, corner + right + down, corner + down};
  quad.mesh.normals.assign(4, glm::normalize(glm::cross(down, right)));
  quad.mesh.triangles = {{0, 3, 2}, {0, 2, 1}};
  const glm::vec4 at[] = {{0, 0, 0, 0}, {1, 0, 0, 1}, {1, 1, 1, 1}, {0, 1, 1, 0}};  // in set 1 turned over
  quad.coordinates = {{at[0], at[3], at[2]}, {at[0], at[2], at[1]}};
  quad.material = material;
  return quad;
}

// Looks straight down on a square of so many metres round a point, +X to the right, +Z down.
inline Camera camera_above(const glm::dvec3& point, double width) {
  Camera camera;
  camera.pose = glm::dmat4(glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 0, -1, 0), glm::dvec4(0, 1, 0, 0),
                           glm::dvec4(point + glm::dvec3(0, 0.5, 0), 1));
  camera.orthographic = true;
  camera.xmag = camera.ymag = width / 2;
  return camera;
}

inline PunctualLight sunlight(const glm::dvec3& towards) {
  PunctualLight light;
  light.type = PunctualLight::Type::directional;
  light.direction = -glm::normalize(towards);
  return light;
}

// Diffuse, base colour 1.
inline Material make_matte(const std::string& name) {
  Material material;
  material.name = name;
  material.metallic = 0;
  return material;
}

inline std::unique_ptr<Setup> make_setup(Scene scene, const RenderOptions& options) {
  scene.file = "test";
  World world = build_world(scene, options.meniscus);
  RenderSettings settings = choose_settings(options, scene, world);
  return std::make_unique<Setup>(Setup{std::move(scene), std::move(world), std::move(settings)});
}

// A floor with all four textures, glass and a mirror with theirs, a lamp with a pattern and the sun.
inline Scene make_gallery() {
  const auto noise = [](std::uint32_t x, std::uint32_t y) {
    const std::uint32_t h = (x * 73856093u ^ y * 19349663u) * 0x2C1B3C6Du;
    return glm::uvec4(h >> 24, h >> 16 & 255u, h >> 8 & 255u, 255);
  };
  const auto colors = make_image(16, 8, false, noise);
  const auto bumps = make_image(8, 8, true, [&](std::uint32_t x, std::uint32_t y) {
    const glm::uvec4 h = noise(x, y);
    return glm::uvec4(20000 + 100 * h.x, 20000 + 100 * h.y, 60000, 65535);
  });
  const auto coarse = make_image(4, 4, false, noise);

  Scene scene;
  Material floor = make_matte("floor");
  floor.base_color_texture = make_texture(colors, true);
  floor.base_color_texture->row = {glm::dvec3(1.5, 0.4, 0.1), glm::dvec3(-0.4, 1.5, 0.2)};
  floor.base_color_texture->wrap_s = Wrap::mirror;
  floor.base_color_texture->wrap_t = Wrap::clamp;
  floor.base_color_texture->set = 1;
  floor.metallic = 0.5;
  floor.metallic_roughness_texture = make_texture(coarse, false);
  floor.metallic_roughness_texture->row[0] *= 3.0;
  floor.normal_texture = make_texture(bumps, false);
  floor.normal_scale = 0.8;
  floor.emission = glm::dvec3(0.02, 0.01, 0);
  floor.emissive_texture = make_texture(coarse, true, true);
  floor.emissive_texture->row[1] *= 2.3;
  Material glass = make_matte("glass");
  glass.roughness = 0;
  glass.transmission = 1;
  glass.base_color_texture = make_texture(colors, true);
  glass.base_color_texture->wrap_t = Wrap::clamp;
  glass.normal_texture = make_texture(bumps, false);
  Material mirror = make_matte("mirror");
  mirror.metallic = 1;
  mirror.roughness = 0;
  mirror.metallic_roughness_texture = make_texture(coarse, false);
  mirror.normal_texture = make_texture(bumps, false);
  mirror.normal_scale = 0.1;
  Material lamp = make_matte("lamp");
  lamp.emission = glm::dvec3(8, 6, 4);
  lamp.emissive_texture = make_texture(coarse, true);
  scene.materials = {floor, glass, mirror, lamp};
  scene.objects = {make_quad("floor", {-1, 0, -1}, {2, 0, 0}, {0, 0, 2}, 0),
                   make_quad("glass", {-0.6, 0.4, -0.5}, {0.7, 0, 0}, {0, 0.1, 0.7}, 1),
                   make_quad("mirror", {-1, 1, -1}, {2, 0, 0}, {0, -1, 0}, 2),
                   make_quad("lamp", {0.9, 1.2, -0.3}, {-0.6, 0, 0}, {0, 0, 0.6}, 3)};
  scene.cameras = {camera_above({0, 0.4, 0.2}, 2)};
  scene.lights = {sunlight({0.3, 1, 0.6})};
  return scene;
}

}  // namespace meniscal::test

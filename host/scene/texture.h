// Textures as plain values: images as their files hold them, and how a material reads them (glTF 2.0, 3.8).
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

namespace meniscal {

// Rows from the upper left corner on. A texel is red, green, blue and alpha, of 8 bits in one word or of 16 bits in
// two, red in the lowest bits.
struct TextureImage {
  std::string name{};
  std::uint32_t width = 0, height = 0;
  bool deep = false;  // 16 bits
  std::vector<std::uint32_t> words{};
};

enum class Wrap { repeat, clamp, mirror };

struct Texture {
  std::shared_ptr<const TextureImage> image{};
  bool srgb = false;  // red, green and blue are encoded so; else linear
  int set = 0;        // of texture coordinates: 0 or 1
  // KHR_texture_transform: the place in the image is (row[0] . (x, y, 1), row[1] . (x, y, 1)), from the upper left
  // corner at (0, 0) to the lower right one at (1, 1).
  std::array<glm::dvec3, 2> row{glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)};
  Wrap wrap_s = Wrap::repeat, wrap_t = Wrap::repeat;
  bool nearest = false;  // else bilinear
};

}  // namespace meniscal

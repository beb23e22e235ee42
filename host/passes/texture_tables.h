// The world's textures on the GPU: shaders/textures.glsl reads them.
#pragma once

#include "host/gpu/buffer.h"
#include "host/world/world.h"

namespace meniscal::passes {

struct TextureTables {
  gpu::Buffer
      textures;        // texels: MaterialTextures[], then Texture[], then three a textured triangle: CornerCoordinates
  gpu::Buffer images;  // words: each image once
  std::uint32_t kinds = 0;              // shared::TEXTURE_* that there are
  std::uint32_t first_coordinates = 0;  // texel of `textures`

  TextureTables(const gpu::Device& device, const World& world);

  // Where those of a triangle begin, WorldTriangle::coordinates of it; 0: it has none.
  std::uint32_t coordinates(std::uint32_t of_world) const {
    return of_world == 0 ? 0 : first_coordinates + 3 * (of_world - 1);
  }
};

}  // namespace meniscal::passes

// The images of the file, decoded when first asked for.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "host/scene/messages.h"
#include "host/scene/texture.h"
#include "host/stages.h"

namespace meniscal::gltf {

// Of all images together: a few bytes of PNG may claim any size. 2 GiB, at 8 bits.
inline constexpr std::uint64_t max_texels = std::uint64_t{1} << 29;
// And beyond so many no more than so many for each byte of their files: those are of one colour, or mean harm.
inline constexpr std::uint64_t free_texels = std::uint64_t{1} << 26, texels_per_byte = 64;

class Images {
 public:
  // Both must outlive this.
  Images(const tinygltf::Model& model, const Messages& messages)
      : model_(model), messages_(messages), decoded_(model.images.size()) {}

  // Fails where its file is missing, is neither PNG nor JPEG, or is damaged, and above the bounds on texels.
  std::shared_ptr<const TextureImage> decode(std::size_t index);
  const Stages& stages() const { return stages_; }

 private:
  const tinygltf::Model& model_;
  const Messages& messages_;
  std::vector<std::shared_ptr<const TextureImage>> decoded_;
  std::uint64_t texels_ = 0, bytes_ = 0;  // so far
  Stages stages_;
};

}  // namespace meniscal::gltf

// Vulkan's declarations, with functions loaded at run time by volk: the program starts where no Vulkan is installed.
#pragma once

#include <volk.h>

namespace meniscal::gpu {

// A structure of Vulkan, all zero but for its type.
template <class Structure>
Structure vk_structure(VkStructureType type) {
  Structure structure{};
  structure.sType = type;
  return structure;
}

}  // namespace meniscal::gpu

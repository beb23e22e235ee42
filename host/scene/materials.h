// Materials: core PBR factors and textures, the KHR_materials_* extensions this project renders, and `extras`.
#pragma once

#include <tiny_gltf.h>

#include <vector>

#include "host/scene/messages.h"
#include "host/scene/scene.h"

namespace meniscal::gltf {

// One a glTF material, in order. Every factor is checked for its range; what is not rendered is warned of.
std::vector<Material> read_materials(const tinygltf::Model& model, Messages& messages, Stages& stages);

}  // namespace meniscal::gltf

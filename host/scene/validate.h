// Checks a parsed model before anything of it is read: afterwards every index, buffer view and accessor is in bounds,
// and the node hierarchy is a forest. tinygltf 2.7 lets all of these pass.
#pragma once

#include <tiny_gltf.h>

#include <string_view>

#include "host/scene/messages.h"

namespace meniscal::gltf {

// Whether this loader knows the glTF extension of that name.
bool is_supported(std::string_view extension);

// Throws Error(ExitCode::scene) naming the object; warns of extensions and features that are left out.
// `binary`: the model came from a .glb.
void validate(const tinygltf::Model& model, bool binary, Messages& messages);

}  // namespace meniscal::gltf

// How materials read textures: samplers and KHR_texture_transform.
#pragma once

#include <tiny_gltf.h>

#include "host/scene/images.h"
#include "host/scene/scene.h"

namespace meniscal::gltf {

// Fills in the material's textures. Those of a liquid, whose surface is made anew, and of coordinates other than the
// sets 0 and 1 are left out with a warning.
void read_textures(const tinygltf::Model& model, const tinygltf::Material& source, const std::string& object,
                   Images& images, Material& material, Messages& messages);

// Whether any of its textures reads that set of coordinates.
bool reads_set(const Material& material, int set);

}  // namespace meniscal::gltf

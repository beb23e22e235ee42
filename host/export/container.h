// A document as the bytes of a file.
#pragma once

#include <string>

#include "host/export/document.h"

namespace meniscal::gltf {

std::string as_glb(Document document);   // binary container, glTF 2.0 section 4.4
std::string as_text(Document document);  // .gltf, the buffer as base64 in it

}  // namespace meniscal::gltf

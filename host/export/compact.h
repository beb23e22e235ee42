// Leaves out what a changed document no longer uses.
#pragma once

#include "host/export/document.h"

namespace meniscal::gltf {

// Drops meshes that no node shows, then accessors and buffer views to which nothing refers, with their bytes. A
// document with extensions that are not known here stays as it is: they may refer to anything.
void compact(Document& document);

}  // namespace meniscal::gltf

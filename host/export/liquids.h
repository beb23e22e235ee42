// The document's liquids replaced by their surfaces with menisci.
#pragma once

#include <vector>

#include "host/export/document.h"
#include "host/scene/scene.h"
#include "host/world/menisci.h"

namespace meniscal::gltf {

// Each liquid becomes a mesh of its own where it was in the hierarchy, of two primitives: the liquid, and its menisci
// with a material that makes them targets of this renderer's photons. Positions are relative to a node near them, so
// that float holds them wherever the scene is. Solids forget their contact angles with these liquids by name. Throws
// Error(ExitCode::scene) where a node has a scale of 0.
void replace_liquids(Document& document, const Source& source, const Scene& scene,
                     const std::vector<LiquidSurface>& liquids, Messages& messages);

}  // namespace meniscal::gltf

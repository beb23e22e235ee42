#include "host/reference/materials.h"

namespace meniscal::reference {

shared::Surface shade(const World& world, Hit& hit) { return world.surfaces[world.triangles[hit.triangle].material]; }

}  // namespace meniscal::reference

// A liquid modelled just up to its container's walls, or a little short of them, made to reach into them.
#pragma once

#include <string>
#include <vector>

#include "meniscus/body.h"
#include "meniscus/warning.h"

namespace meniscus {

// Moves those points of the free surface's border that lie within `tolerance` of a wall that faces them outward by
// twice as much, in the plane: coincident faces would part the liquid by chance. Warns, with the tolerance, where
// points were moved.
void snap_border(Topology& liquid, const std::vector<std::uint32_t>& surface, const std::string& name,
                 const std::vector<Body>& bodies, double tolerance, Warnings& warnings);

}  // namespace meniscus

// What comes in, checked and made usable: welded, oriented, with normals.
#pragma once

#include <cstdint>
#include <vector>

#include "meniscus/body.h"
#include "meniscus/meniscus.h"
#include "meniscus/warning.h"

namespace meniscus {

// The liquid, turned over if nothing of it faces up, and its free surface with normals. Throws std::invalid_argument,
// naming the liquid, where it has no free surface or a parameter is none.
Topology weld_liquid(const Liquid& liquid, std::vector<std::uint32_t>& surface, Warnings& warnings);

// The solids in their order, facing outward. Throws std::invalid_argument, naming the solid.
std::vector<Body> weld_solids(const std::vector<Solid>& solids, Warnings& warnings);

}  // namespace meniscus

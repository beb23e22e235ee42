// Which side is liquid: winding numbers of the solids over the surface, found by flooding it.
#pragma once

#include <vector>

#include "meniscus/bond.h"
#include "meniscus/patch.h"
#include "meniscus/triangulate.h"
#include "meniscus/warning.h"

namespace meniscus {

// Per triangle of the triangulation: how often the patch covers it, and how many solids lie round it (0: liquid).
struct Winding {
  std::vector<int> patch, solid;
};

// Floods across edges, counting constraints, from the outside for the patch and from one seed in each part of it for
// the solids. A seed's number of solids comes from generalised winding numbers; far from whole ones (open solids) there
// is a warning.
Winding find_windings(const Triangulation& mesh, const Patch& base, const std::vector<Body>& bodies,
                      Warnings& warnings);

// Per triangle of the liquid: true for those of the free surface beside the patch that lie inside solids. Reached from
// the patch's border, where `drowned` are its edges inside solids; parts of the surface that no contour meets are asked
// themselves.
std::vector<bool> find_drowned(const Topology& liquid, const std::vector<std::uint32_t>& surface, const Patch& patch,
                               const std::vector<Edge>& drowned, const std::vector<Body>& bodies);

}  // namespace meniscus

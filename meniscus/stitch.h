// Band and remaining liquid joined into one surface with shared vertices.
#pragma once

#include "meniscus/meniscus.h"
#include "meniscus/raise.h"

namespace meniscus {

struct Stitched {
  TriangleMesh mesh;
  TriangleMesh within;  // the free surface inside solids; shares the contact lines' positions, but no vertices
  std::vector<std::uint8_t> meniscus;
  std::vector<std::size_t> line;  // per triangle of a meniscus: its contact line
  // Per vertex: on a contact line or on the liquid's own border, where an edge may have one triangle.
  std::vector<bool> may_end;
};

// Joins the sheet, raised, to the untouched triangles of the liquid, less those of the free surface inside solids,
// which are kept apart. Walls of a closed liquid follow where the border of its free surface was divided or moved.
Stitched stitch(const Topology& liquid, const std::vector<std::uint32_t>& surface, const Patch& patch,
                const Sheet& sheet, const Raised& raised, const std::vector<Body>& bodies);

}  // namespace meniscus

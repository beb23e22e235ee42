// From a primitive's vertices to a renderable triangle mesh: triangulation, closedness, transformation, normals.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "meniscus/mesh.h"

namespace meniscal::gltf {

// Triangles of a primitive of mode 4 (triangles), 5 (strip) or 6 (fan), counter-clockwise as glTF defines them
// (2.0, 3.7.2.1). Mode 4 needs a multiple of three indices; the remainder is left out.
std::vector<glm::uvec3> triangulate(const std::vector<std::uint32_t>& indices, int mode);

// Drops triangles with two corners in one place; returns how many.
std::size_t drop_collapsed(meniscus::TriangleMesh& mesh);
// Drops the other triangles without area (three corners on a line); returns how many. They count for closedness.
std::size_t drop_flat(meniscus::TriangleMesh& mesh);

// Whether every edge of the parts together belongs to exactly two triangles, positions that are equal taken as one.
bool is_closed(const std::vector<meniscus::TriangleMesh>& parts);

// Positions by `to_world`, normals by its inverse transpose (unit length; zero stays zero); a mirroring flips the
// winding.
meniscus::TriangleMesh transformed(const meniscus::TriangleMesh& mesh, const glm::dmat4& to_world);

// Gives every corner whose vertex has no normal, or one of length zero, the normal of its facet, with a vertex of its
// own. Afterwards all normals have unit length and no vertex is unused. Needs triangles with area.
void complete_normals(meniscus::TriangleMesh& mesh);

// The largest angle in radians between file normal and facet normal on the up-facing (+Y), nearly level triangles; 0 if
// there are none.
double straying_of_level_normals(const meniscus::TriangleMesh& mesh);

// Replaces the normals of the up-facing triangles' corners by the mean of the up-facing facet normals around the
// corner's position, weighted by angle. Vertices shared with other triangles are split.
void recompute_upward_normals(meniscus::TriangleMesh& mesh);

}  // namespace meniscal::gltf

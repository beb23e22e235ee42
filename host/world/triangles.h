// Meshes as the triangles that are rendered.
#pragma once

#include <cstdint>
#include <vector>

#include "host/world/world.h"

namespace meniscal {

// Adds the mesh's triangles that have an area. What is not of their shape is that of `usual`; its `coordinates` are of
// the mesh's first. `meniscus`: which of them belong to a meniscus that matters.
void append(std::vector<WorldTriangle>& triangles, const meniscus::TriangleMesh& mesh, const WorldTriangle& usual,
            const std::vector<std::uint8_t>* meniscus = nullptr);

// Drops those that lie on an earlier one of the same material, corner on corner, and face alike; returns how many. A
// ray meets one of them, but would have to look at all. Its normals and textures stay. So do all faces
// that light goes through.
std::size_t drop_coincident(std::vector<WorldTriangle>& triangles, const std::vector<shared::Surface>& surfaces);

// Radius of a sphere round the local origin that holds all of them, metres.
double radius_of(const std::vector<WorldTriangle>& triangles);

// Whether the line through the point along the triangle's normal meets it; where corners are in a line, it does not.
bool is_over(const WorldTriangle& triangle, const glm::dvec3& point);

}  // namespace meniscal

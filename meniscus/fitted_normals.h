// Normals of a curved surface from the positions of a mesh's vertices alone.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace meniscus {

// For each vertex the normal of the paraboloid through it that fits its neighbours, and theirs, best:
// off by the square of their distance, where means of the facets' normals are off by as much as the mesh is uneven.
// `about` holds a rough normal for each vertex, on the side to answer; it is the answer where too few neighbours are.
std::vector<glm::dvec3> fit_normals(const std::vector<glm::dvec3>& positions, const std::vector<glm::uvec3>& triangles,
                                    const std::vector<glm::dvec3>& about);

}  // namespace meniscus

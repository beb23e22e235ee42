// Solids bent from rods, and heaps of solids, for generated scenes.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <random>
#include <vector>

#include "meniscus/mesh.h"

namespace shapes {

// A round rod of `facets` sides along the curve, given at parameters 0..1 and sampled in `steps` parts: smooth side,
// flat ends; `radius(t)`. Frames turn as little as they can, so that the sides do not twist.
meniscus::TriangleMesh rod(const std::function<glm::dvec3(double)>& curve, const std::function<double(double)>& radius,
                           int facets, int steps);
meniscus::TriangleMesh rod(const std::function<glm::dvec3(double)>& curve, double radius, int facets, int steps);

// A helix about +Y that starts at height y0.
std::function<glm::dvec3(double)> helix(double radius, double pitch, double turns, double y0);
// The wire of a paper clip, in the plane y = 0, about 30 mm long for size 1e-3.
std::function<glm::dvec3(double)> clip(double size);

// Thin rods through points of the square of half-width `half` round the origin, in random directions up to `slant`
// degrees off +Y, no two nearer than `apart` at the level y = 0.
std::vector<meniscus::TriangleMesh> needles(int count, double half, double radius, double length, double slant,
                                            double apart);

// All parts as one mesh.
meniscus::TriangleMesh joined(const std::vector<meniscus::TriangleMesh>& parts);

}  // namespace shapes

// What tests ask of a surface with menisci on a square sheet round the origin.
#pragma once

#include <cstddef>
#include <set>

#include "meniscus/check.h"
#include "meniscus/meniscus.h"
#include "tests/unit/meniscus_shapes.h"

namespace surfaces {

using meniscus::Report;
using meniscus::Surface;
using shapes::TriangleMesh;

constexpr double kSweep = 2 * shapes::kWater;

inline TriangleMesh tall_post(int facets = 256) {
  return shapes::post(2 * shapes::kMm, -50 * shapes::kMm, 10 * shapes::kMm, facets);
}

// What must hold of every result; gives the topology.
Report expect_sound(const Surface& surface, double least_angle = 1);

double plan_area(const Surface& surface, bool meniscus_only);

// Boundary vertices that are not on the border of the sheet of half-width `half`.
std::set<std::size_t> contact_vertices(const Surface& surface, const Report& report, double half);

void expect_contact_on(const TriangleMesh& solid, const Surface& surface, const Report& report,
                       double half = 30 * shapes::kMm);

}  // namespace surfaces

// Corners too narrow for their contact angle.
#pragma once

#include "meniscus/columns.h"
#include "meniscus/warning.h"

namespace meniscus {

// The contact angle at each node of a line. Where the solid's sides meet in so narrow a corner that no plane keeps the
// angle to both, the liquid would rise (sink) in it without bound (Concus, Finn 1969): there, up to kRounded capillary
// lengths from the corner, it is the nearest angle for which the rise is finite, with a warning that names the solid.
std::vector<double> finite_angles(const ContactLine& line, double contact_angle, double capillary_length,
                                  const std::string& solid, Warnings& warnings);

}  // namespace meniscus

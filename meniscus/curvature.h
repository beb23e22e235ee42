// How a contour is curved, on the scale on which a liquid takes notice.
#pragma once

#include "meniscus/columns.h"

namespace meniscus {

// Sets the curvature of every node: the turn of the contour's normals per length, corners included, in a mean that
// falls linearly to weight 0 at `within` metres along the line to both sides. That of a circle is exact; a prism
// thinner than `within` has nearly that of a circle of its girth. An open line goes on as its mirror image.
void measure_curvature(ContactLine& line, double within);

}  // namespace meniscus

// How far apart the columns of the band may stand along each contact line.
#pragma once

#include <vector>

#include "meniscus/bond.h"
#include "meniscus/patch.h"
#include "meniscus/warning.h"

namespace meniscus {

// One resolution for each of the lines, which are those of `refine` without one. Columns stand as near as there at
// joints, at ends, where the band reaches the liquid's own border, and where it is cut off aslant by its other parts
// or by neighbours; from there they spread until triangles are kAspect times as long as wide, or as the turn of the
// line allows. Nothing changes along a straight wall, so nothing is lost there. Contours that would still give more
// than two million triangles together (600,000 of the exact profile, whose time is that of solving for them) get
// coarser ones; a warning says what error that leaves, if it is beyond the tolerance.
std::vector<Resolution> find_resolutions(const std::vector<ContactLine>& lines, const std::vector<Body>& bodies,
                                         const Patch& patch, double sweep_length, double reach, Warnings& warnings);

}  // namespace meniscus

// The paper's height function, equation (2), and how its angle alpha is read.
#pragma once

#include "meniscus/meniscus.h"

namespace meniscus {

// Distance from the contour to the end of the meniscus: S = 2 L, times the artist's factor. Metres.
double sweep_length(const Liquid& liquid);

// Height of the contact line above the level liquid, h(0, alpha) = 2 L (1 - alpha / pi) times the artist's factor.
// Metres, signed. `beta` is the dihedral angle between solid and level liquid, through the liquid (90 degrees for a
// vertical wall); radians. wetting: alpha = pi - (beta - theta); equation2: alpha = theta, as printed.
double rise(const Liquid& liquid, double contact_angle, double beta);

// The factor that eq. (2) applies to the rise at d = distance / S in [0, 1], 0 beyond; and its derivative by d.
double profile(double d);
double profile_slope(double d);

}  // namespace meniscus

// The paper's height function, equation (2): how high the contact line stands and how the meniscus falls off from
// there.
#pragma once

#include "meniscus/meniscus.h"

namespace meniscus {

// Capillary lengths from a contact line to where a solved surface is level but for 0.03 % of its rise and slope.
constexpr double kFar = 8;

// Distance from the contour to the end of the meniscus: S = 2 L, times the artist's factor. Metres.
double sweep_length(const Liquid& liquid);

// How far the surface is raised: to the end of the meniscus, and where it is solved for, to where it is level. Metres.
double raised_length(const Liquid& liquid);

// Height of the contact line above the level liquid by the liquid's height rule, times the artist's factor. Metres,
// signed. `beta` is the dihedral angle between solid and level liquid, through the liquid (90 degrees for a vertical
// wall); radians. `curvature` of the contour, 1/m, positive round a post. wetting and equation2: 2 L (1 - alpha / pi)
// with alpha = pi - (beta - theta) or, as printed, theta; exact: by Young-Laplace, see young_laplace.h.
double rise(const Liquid& liquid, double contact_angle, double beta, double curvature = 0);

// The factor on the rise at d = distance / S: 1 at the contact line, 0 from d = 1 on, where all profiles run out level;
// and its derivatives by d. The circular one is vertical at the wall: its derivatives there are those at d = 1e-8.
struct Falloff {
  double height = 0, slope = 0, bend = 0, jerk = 0;
};
Falloff falloff(Profile profile, double d);

}  // namespace meniscus

// The exact height of a contact line: the Young-Laplace equation round a cylinder and within a tube.
#pragma once

namespace meniscus {

// Height above the level far away, in capillary lengths, of a liquid that meets a wall with slope `slope` (radians,
// in (-pi, pi); positive rises; dihedral minus contact angle), where the wall's contour has curvature `curvature` (per
// capillary length): positive round a post, 0 at a flat wall (2 sin(slope / 2)), negative within a tube. To 1e-6
// relative between slopes of -150 and 150 degrees and curvatures of -1e6 and 1e6. From a table made at the first call,
// 10 ms.
double exact_rise(double slope, double curvature);

}  // namespace meniscus

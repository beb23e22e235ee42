// The liquid's surface at rest: Young-Laplace's equation, 2 C = h / L^2, with every contact line at its angle.
#pragma once

#include "meniscus/film.h"

namespace meniscus {

// Moves what is raised to where it rests: vertices, normals and the rises of the lines' contacts. What is as good as
// level there no longer counts as raised: photons are started where they are bent. Parts of the sheet that share no
// moving vertex are solved one by one. One that does not converge is at rest for contact angles as near to the solids'
// as could be reached, or stays as it was raised where these are far off; both with a warning. Corners: see corner.h.
// `as_raised` are the warnings about the start, which count only for parts that stay so.
Solution equilibrate(Raised& raised, Sheet& sheet, std::vector<ContactLine>& lines, const std::vector<Body>& bodies,
                     const Liquid& liquid, const Warnings& as_raised, Warnings& warnings);

}  // namespace meniscus

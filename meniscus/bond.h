// Raises a contact line on its solid and bonds it there by ray tests (paper, section 3.2 and figure 6).
#pragma once

#include "meniscus/body.h"
#include "meniscus/columns.h"
#include "meniscus/meniscus.h"

namespace meniscus {

// Sets rise and slide of every node: the rise from the height rule and the room there is, the slide so that the contact
// vertex lies on the solid: along the way on which the solid goes on as a whole, then by a ray along the contour
// normal. Where the solid ends below (or above) the height, or slants too much, the line is pinned and its nodes' room
// set to what is left. At joints the rise is the mean of both sides' and fades into theirs, as does the joint's slide
// along the line. Sets sweep to 0 where nothing rises. Returns how many nodes are pinned.
std::size_t bond(ContactLine& line, const Body& body, const Liquid& liquid);

// How far a contact line slides out over the level liquid, at most, on a solid as slanted as where they meet; metres.
double run_out(const ContactLine& line, const Body& body, const Liquid& liquid);

}  // namespace meniscus

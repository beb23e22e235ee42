// Slides handed on between neighbours: what lies between two contact lines moves with both.
#pragma once

#include <vector>

#include "meniscus/columns.h"

namespace meniscus {

// Sets reach and toward of all sides from the slides of all lines: where a column meets a crease before its meniscus
// ends, it moves there as the mean of the contact lines nearby does, less the farther away they are. To be called when
// the lines' slides are known; asks only for lines near `changed` ones (by index), which are added to it where
// something changed for them.
void share_slides(std::vector<ContactLine>& lines, std::vector<bool>& changed);

}  // namespace meniscus

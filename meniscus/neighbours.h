// What a meniscus owes to the walls and menisci near it.
#pragma once

#include <vector>

#include "meniscus/columns.h"

namespace meniscus {

// Sets how far each node's column is free of other feet, metres, at most `reach`. Looks within `first` metres, then
// farther and farther: what is tried beyond a near wall stands inside it.
void find_free_lengths(std::vector<ContactLine>& lines, double first, double reach);

// Between near walls the surface bends within their distance: the exact profile's layers follow the narrowest tenth.
void refine_in_gaps(ContactLine& line, double reach);

// Where a solid is met level, the liquid still rises as neighbours' menisci reach it: gives those lines a meniscus.
void wake_neighbours(std::vector<ContactLine>& lines, double reach);

}  // namespace meniscus

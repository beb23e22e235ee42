// How highlights are looked for: constants, and where in its cells a pixel looks.
#ifndef MENISCAL_HIGHLIGHTS_H
#define MENISCAL_HIGHLIGHTS_H
#include "random.h"

SHARED_BEGIN

// Lights without extent are seen as discs of half a degree: as points, they would be single pixels of any brightness.
const float LEAST_VERSINE = 9.5e-6f;  // of the disc's radius
// Suns of more than 60 degrees are left to camera paths: to first order, a cell sees nothing of their edges. Versine of the radius.
const float MOST_VERSINE = 0.134f;
// Derivatives tell nothing of what lies behind a ray or nearly across it: the least cosine of a disc.
const float LEAST_AHEAD = 0.1f;
// Added to what a cell spans, rad: on level water an orthographic camera sees but one direction in all of it.
const float LEAST_CELL_ANGLE = 1e-7f;
// Discs are regular polygons of the same area; the radius of their corners by that of the disc.
const uint DISC_CORNERS = 16u;
const float DISC_CIRCUMSCRIBED = 1.0130016f;

// Where the i-th cell of a pixel sends its ray from, in units of the cell: a single pass does best from the middle.
SHARED vec2 cell_place(RandomKey key, uint i) {
  return key.pass == 0u ? vec2(0.5f, 0.5f) : vec2(random_unit(key, 2u * i), random_unit(key, 2u * i + 1u));
}

SHARED_END
#endif

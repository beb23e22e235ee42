// Camera paths at surfaces that reflect a part of the light and let a part through. By roulette a path takes one way or the other; so that
// rare reflections leave no specks, it is split instead, into paths that take their ways by weight and share the light between them.
#ifndef MENISCAL_BRANCHES_H
#define MENISCAL_BRANCHES_H
#include "dialect.h"

SHARED_BEGIN

const uint BRANCH_ROULETTE = 0u;
// At the first such surface through, or reflected; then by roulette.
const uint BRANCH_THROUGH = 1u, BRANCH_REFLECTED = 2u;
// Where there are several: through all of them, or reflected at a later one than the first. The latter's way at each is the toss of a coin,
// until it is reflected; then by roulette. A path that never is belongs to the former.
const uint BRANCH_THROUGH_ALL = 3u, BRANCH_LATER = 4u;

// The way to take after so many surfaces: `split` as told by next_split.
const uint WAY_BY_ROULETTE = 0u, WAY_THROUGH = 1u, WAY_REFLECTED = 2u;
SHARED uint branch_way(uint branch, float split, float coin) {
  if (branch == BRANCH_THROUGH_ALL) return WAY_THROUGH;
  if (split == 0.0f && branch != BRANCH_ROULETTE) return branch == BRANCH_REFLECTED ? WAY_REFLECTED : WAY_THROUGH;
  if (split == 1.0f && branch == BRANCH_LATER) return coin < 0.5f ? WAY_REFLECTED : WAY_THROUGH;
  return WAY_BY_ROULETTE;
}

// The weight of that way, for this part of the light reflected.
SHARED float way_weight(uint branch, float split, uint way, float reflectance) {
  float coins = branch == BRANCH_LATER && split == 1.0f ? 2.0f : 1.0f;
  return way == WAY_BY_ROULETTE ? 1.0f : coins * (way == WAY_REFLECTED ? reflectance : 1.0f - reflectance);
}

// In place of a uniform number that chooses reflection where it is below the part reflected: one that chooses this way.
SHARED float way_number(uint way, float number) {
  return way == WAY_REFLECTED ? 0.0f : way == WAY_THROUGH ? 0.99999994f : number;
}

// Surfaces met so far; on BRANCH_LATER 1 until it is reflected, then 2.
SHARED float next_split(uint branch, float split, uint way) {
  if (branch == BRANCH_LATER) return way == WAY_REFLECTED ? 2.0f : max(split, 1.0f);
  return split + 1.0f;
}

// Whether a path that has ended is another branch's.
SHARED bool branch_ends_empty(uint branch, float split) {
  return (branch == BRANCH_REFLECTED && split == 0.0f) || (branch == BRANCH_LATER && split < 2.0f);
}

SHARED_END
#endif

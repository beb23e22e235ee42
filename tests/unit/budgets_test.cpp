#include "host/render/budgets.h"

#include <gtest/gtest.h>

namespace meniscal {
namespace {

constexpr Budgets usual{80000, 40000};

double noise_of(const Budgets& b, const MapNoise& n) { return n.caustics / b.caustics + n.global / b.global; }

TEST(Budgets, LeaveTheLeastNoise) {
  for (const MapNoise noise : {MapNoise{1, 1}, {2, 1}, {1, 3}, {1.5, 0.8}}) {
    const Budgets best = share_photons(usual, noise);
    const std::uint32_t all = usual.caustics + usual.global;
    EXPECT_NEAR(best.caustics + best.global, all, 1);
    for (std::uint32_t global = all / 3; global <= 2 * all / 3; global += all / 32)
      EXPECT_LE(noise_of(best, noise), 1.001 * noise_of({all - global, global}, noise));
  }
}

TEST(Budgets, OfWhatIsHardlySeenAreSmallButNotNone) {
  const Budgets dark = share_photons(usual, {1, 0}), dull = share_photons(usual, {0, 1});
  EXPECT_EQ(dark.global, 7500u);
  EXPECT_EQ(dull.caustics, 7500u);
  EXPECT_EQ(dark.caustics, 80000u) << "no more than there is room for";
  EXPECT_EQ(dull.global, 80000u);
}

TEST(Budgets, StayWhereThereIsNothingToShare) {
  for (const Budgets b : {Budgets{5000, 0}, Budgets{0, 5000}}) {
    EXPECT_EQ(share_photons(b, {1, 2}).caustics, b.caustics);
    EXPECT_EQ(share_photons(b, {1, 2}).global, b.global);
  }
  EXPECT_EQ(share_photons(usual, {}).global, usual.global);
}

}  // namespace
}  // namespace meniscal

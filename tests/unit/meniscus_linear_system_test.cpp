// Large systems, solved block by block, against factors of the whole.
#include "meniscus/linear_system.h"

#include <gtest/gtest.h>

namespace {

using meniscus::LinearSystem;

constexpr int kSide = 160, kBlock = 40;  // unknowns on a square grid, in square blocks
constexpr int kCount = kSide * kSide;    // more than are factored as a whole

int at(int i, int j) { return i * kSide + j; }

// As of a surface with tension and weight, with a little of what makes those of films not symmetric.
LinearSystem::Matrix screened(double weight) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      entries.emplace_back(at(i, j), at(i, j), 4 + weight * (1 + 0.5 * std::sin(i + 2 * j)));
      if (i > 0) entries.emplace_back(at(i, j), at(i - 1, j), -1.1);
      if (i + 1 < kSide) entries.emplace_back(at(i, j), at(i + 1, j), -0.9);
      if (j > 0) entries.emplace_back(at(i, j), at(i, j - 1), -1);
      if (j + 1 < kSide) entries.emplace_back(at(i, j), at(i, j + 1), -1);
    }
  }
  LinearSystem::Matrix matrix(kCount, kCount);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

LinearSystem in_blocks() {
  std::vector<std::uint32_t> blocks;
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j)
      blocks.push_back(static_cast<std::uint32_t>(i / kBlock * (kSide / kBlock) + j / kBlock));
  return LinearSystem(blocks);
}

Eigen::VectorXd some_right_hand_side() {
  Eigen::VectorXd right(kCount);
  for (int u = 0; u < kCount; ++u) right[u] = std::sin(0.1 * u) + (u % 7 == 0);
  return right;
}

void expect_solution(const LinearSystem::Matrix& matrix, const Eigen::VectorXd& found) {
  constexpr double kPrecise = 1e-3;
  const Eigen::VectorXd right = some_right_hand_side();
  EXPECT_LT((matrix * found - right).norm(), kPrecise * right.norm());
}

TEST(LinearSystem, OfManyBlocksIsSolved) {
  LinearSystem system = in_blocks();
  system.set(screened(0.05));
  expect_solution(screened(0.05), system.solve(some_right_hand_side()));
}

TEST(LinearSystem, IsSolvedWithTheFactorsOfAnotherMatrix) {
  LinearSystem system = in_blocks();
  for (const double weight : {0.05, 0.06, 5.0, 0.02}) {
    SCOPED_TRACE(weight);
    system.set(screened(weight));
    expect_solution(screened(weight), system.solve(some_right_hand_side()));
  }
}

TEST(LinearSystem, OfWhatIsNotFiniteHasNoSolution) {
  LinearSystem system = in_blocks();
  system.set(screened(std::nan("")));
  EXPECT_FALSE(system.solve(some_right_hand_side()).allFinite());
}

}  // namespace

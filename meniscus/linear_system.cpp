#include "meniscus/linear_system.h"

#include <Eigen/IterativeLinearSolvers>
#include <algorithm>
#include <limits>

namespace meniscus {

// With Eigen's interface.
struct LinearSystem::Preconditioner {
  const LinearSystem* system = nullptr;

  Preconditioner& analyzePattern(const Matrix&) { return *this; }
  Preconditioner& factorize(const Matrix&) { return *this; }
  Preconditioner& compute(const Matrix&) { return *this; }
  Eigen::ComputationInfo info() const { return Eigen::Success; }
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const { return system->solve_by_blocks(right); }
};

LinearSystem::LinearSystem(const std::vector<std::uint32_t>& blocks) {
  constexpr std::size_t kWhole = 20'000;
  const bool whole = blocks.size() <= kWhole;
  blocks_.resize(whole ? 1 : 1 + *std::max_element(blocks.begin(), blocks.end()));
  for (std::size_t u = 0; u < blocks.size(); ++u) blocks_[whole ? 0 : blocks[u]].own.push_back(static_cast<int>(u));
}

void LinearSystem::set(Matrix matrix) {
  constexpr long kMore = 3;  // iterations: then new factors take less time
  matrix_ = std::move(matrix);
  if (last_ > first_ + kMore) factored_ = false;
}

void LinearSystem::factor() {
  constexpr int kAround = 3;  // neighbours of neighbours of neighbours
  const Matrix transposed = matrix_.transpose();
  std::vector<int> place(static_cast<std::size_t>(matrix_.rows()), -1);  // in the block at hand
  for (Block& block : blocks_) {
    std::vector<int>& unknowns = block.unknowns = block.own;
    for (std::size_t i = 0; i < unknowns.size(); ++i) place[unknowns[i]] = static_cast<int>(i);
    std::size_t done = 0;
    for (int ring = 0; ring < kAround && blocks_.size() > 1; ++ring) {
      for (const std::size_t end = unknowns.size(); done < end; ++done) {
        for (Matrix::InnerIterator e(transposed, unknowns[done]); e; ++e) {  // what its equation depends on
          int& at = place[e.index()];
          if (at < 0) at = static_cast<int>(unknowns.size()), unknowns.push_back(static_cast<int>(e.index()));
        }
      }
    }
    std::vector<Eigen::Triplet<double>> entries;
    for (const int u : unknowns)
      for (Matrix::InnerIterator e(matrix_, u); e; ++e)
        if (place[e.index()] >= 0) entries.emplace_back(place[e.index()], place[u], e.value());
    for (const int u : unknowns) place[u] = -1;
    const auto size = static_cast<Eigen::Index>(unknowns.size());
    Matrix here(size, size);
    here.setFromTriplets(entries.begin(), entries.end());
    block.factors = std::make_unique<Factors>(here);
  }
  factored_ = true;
}

Eigen::VectorXd LinearSystem::solve_by_blocks(const Eigen::VectorXd& right) const {
  Eigen::VectorXd result(right.size());
  for (const Block& block : blocks_) {
    if (block.factors->info() != Eigen::Success)
      return Eigen::VectorXd::Constant(right.size(), std::numeric_limits<double>::quiet_NaN());
    const Eigen::VectorXd solved = block.factors->solve(Eigen::VectorXd(right(block.unknowns)));
    for (std::size_t i = 0; i < block.own.size(); ++i) result[block.own[i]] = solved[static_cast<Eigen::Index>(i)];
  }
  return result;
}

Eigen::VectorXd LinearSystem::solve(const Eigen::VectorXd& right) {
  constexpr double kPrecise = 1e-4;
  constexpr int kOld = 12, kMost = 60;  // iterations with factors of an earlier matrix, and with its own
  const Eigen::VectorXd none = Eigen::VectorXd::Constant(right.size(), std::numeric_limits<double>::quiet_NaN());
  if (!matrix_.coeffs().allFinite() || !right.allFinite()) return none;
  const bool old = factored_;
  if (!old) factor();
  Eigen::BiCGSTAB<Matrix, Preconditioner> iteration;
  iteration.preconditioner().system = this;
  iteration.setTolerance(kPrecise);
  iteration.setMaxIterations(old ? kOld : kMost);
  iteration.compute(matrix_);
  const Eigen::VectorXd result = iteration.solve(right);
  (old ? last_ : first_) = iteration.iterations();
  if (!old) last_ = first_;
  if (iteration.info() == Eigen::Success && result.allFinite()) return result;
  if (!old) return none;
  factored_ = false;
  return solve(right);
}

}  // namespace meniscus

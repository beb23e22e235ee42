// Linear equations with a large sparse matrix, solved again and again while the matrix changes little.
#pragma once

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <cstdint>
#include <memory>
#include <vector>

namespace meniscus {

// By iteration, preconditioned with factors of this matrix or of an earlier one as long as they are good enough. The
// unknowns fall into blocks that are coupled to near ones alone, as menisci are: gravity screens what is farther away
// than some capillary lengths. Small matrices are factored as a whole, of large ones each block with some of what
// surrounds it (restricted additive Schwarz; Cai, Sarkis 1999): whole factors take time that grows with the power 3/2.
class LinearSystem {
 public:
  using Matrix = Eigen::SparseMatrix<double>;

  explicit LinearSystem(const std::vector<std::uint32_t>& blocks);  // of each unknown, from 0 on

  void set(Matrix matrix);
  // To a part of 1e-3 of the right-hand side; not finite where no solution is found.
  Eigen::VectorXd solve(const Eigen::VectorXd& right);

 private:
  using Factors = Eigen::SparseLU<Matrix, Eigen::COLAMDOrdering<int>>;
  struct Block {
    std::vector<int> own, unknowns{};  // without and with those around it, which come last
    std::unique_ptr<Factors> factors{};
  };
  struct Preconditioner;

  void factor();
  Eigen::VectorXd solve_by_blocks(const Eigen::VectorXd& right) const;

  Matrix matrix_;
  std::vector<Block> blocks_;
  bool factored_ = false;
  long first_ = 0, last_ = 0;  // iterations with these factors, for their own matrix and at last
};

}  // namespace meniscus

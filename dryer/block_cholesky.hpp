// Sparse symmetric positive definite systems made of 6 x 6 blocks: one block row a particle, one off-diagonal block a
// bond.
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <cstdint>
#include <vector>

#include "common/agglomerate/agglomerate.hpp"

namespace crumble::dryer {

struct BlockPair {
  std::int32_t i, j;  // i != j, blocks counted from 0
};

// The pattern is set once per contact network (fill-reducing order by approximate minimum degree on the block graph)
// and refilled with numbers as often as needed. Factorisation and solves are Eigen's.
class BlockCholesky {
 public:
  void set_pattern(std::int32_t blocks, const std::vector<BlockPair>& pairs);

  void clear();
  void add_diagonal(std::int32_t i, const Matrix6& block);
  // Adds the block coupling row i to column j of pair k; its transpose is implied.
  void add_pair(std::size_t k, const Matrix6& block_ij);

  bool factorise();  // false if the matrix is not positive definite
  void solve(const std::vector<Vector6>& right, std::vector<Vector6>& solution);

 private:
  std::vector<std::int32_t> place_;  // block -> row in the fill-reducing order
  struct Slot {
    std::int64_t offset;  // of the block's first row within each of its six columns
    std::int32_t column;  // block column
    bool transposed;
  };
  std::vector<Slot> diagonal_, pair_;
  Eigen::SparseMatrix<double> matrix_;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>> factor_;
  Eigen::VectorXd work_;
};

}  // namespace crumble::dryer

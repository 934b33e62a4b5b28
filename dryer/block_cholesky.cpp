#include "dryer/block_cholesky.hpp"

#include <Eigen/OrderingMethods>
#include <algorithm>

namespace crumble::dryer {

void BlockCholesky::set_pattern(std::int32_t blocks, const std::vector<BlockPair>& pairs) {
  // Order the block graph, not the scalar one: 36 times smaller.
  std::vector<Eigen::Triplet<double>> edges;
  for (std::int32_t p = 0; p < blocks; ++p) edges.emplace_back(p, p, 1.0);
  for (const BlockPair& pair : pairs) {
    edges.emplace_back(pair.i, pair.j, 1.0);
    edges.emplace_back(pair.j, pair.i, 1.0);
  }
  Eigen::SparseMatrix<double> graph(blocks, blocks);
  graph.setFromTriplets(edges.begin(), edges.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(graph, order);
  place_.resize(blocks);
  for (std::int32_t k = 0; k < blocks; ++k) place_[order.indices()[k]] = k;

  // Lower triangle by block columns; a column of scalars holds its diagonal block in full (Lower ignores the rest).
  std::vector<std::vector<std::int32_t>> below(blocks);
  for (const BlockPair& pair : pairs) {
    const auto [column, row] = std::minmax(place_[pair.i], place_[pair.j]);
    below[column].push_back(row);
  }
  matrix_.resize(6 * blocks, 6 * blocks);
  std::vector<std::int64_t> height(blocks);
  std::int64_t nonzeros = 0;
  for (std::int32_t c = 0; c < blocks; ++c) {
    std::sort(below[c].begin(), below[c].end());
    height[c] = 6 * (1 + static_cast<std::int64_t>(below[c].size()));
    nonzeros += 6 * height[c];
  }
  matrix_.resizeNonZeros(nonzeros);
  std::int64_t next = 0;
  for (std::int32_t c = 0; c < blocks; ++c)
    for (int k = 0; k < 6; ++k) {
      matrix_.outerIndexPtr()[6 * c + k] = static_cast<int>(next);
      for (int row = 0; row < 6; ++row) matrix_.innerIndexPtr()[next++] = 6 * c + row;
      for (const std::int32_t b : below[c])
        for (int row = 0; row < 6; ++row) matrix_.innerIndexPtr()[next++] = 6 * b + row;
    }
  matrix_.outerIndexPtr()[6 * blocks] = static_cast<int>(next);

  diagonal_.clear();
  for (std::int32_t p = 0; p < blocks; ++p) diagonal_.push_back({0, place_[p], false});
  pair_.clear();
  for (const BlockPair& pair : pairs) {
    const std::int32_t i = place_[pair.i], j = place_[pair.j];
    const auto& rows = below[std::min(i, j)];
    const auto slot = std::lower_bound(rows.begin(), rows.end(), std::max(i, j)) - rows.begin();
    pair_.push_back({6 * (1 + slot), std::min(i, j), i < j});
  }
  clear();
  factor_.analyzePattern(matrix_);
  work_.resize(6 * blocks);
}

void BlockCholesky::clear() { std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0); }

void BlockCholesky::add_diagonal(std::int32_t i, const Matrix6& block) {
  const Slot& slot = diagonal_[i];
  for (int c = 0; c < 6; ++c) {
    double* values = matrix_.valuePtr() + matrix_.outerIndexPtr()[6 * slot.column + c];
    Eigen::Map<Vector6>{values} += block.col(c);
  }
}

void BlockCholesky::add_pair(std::size_t k, const Matrix6& block_ij) {
  const Slot& slot = pair_[k];
  for (int c = 0; c < 6; ++c) {
    double* values = matrix_.valuePtr() + matrix_.outerIndexPtr()[6 * slot.column + c] + slot.offset;
    if (slot.transposed)
      Eigen::Map<Vector6>{values} += block_ij.row(c).transpose();
    else
      Eigen::Map<Vector6>{values} += block_ij.col(c);
  }
}

bool BlockCholesky::factorise() {
  factor_.factorize(matrix_);
  return factor_.info() == Eigen::Success;
}

void BlockCholesky::solve(const std::vector<Vector6>& right, std::vector<Vector6>& solution) {
  for (std::size_t p = 0; p < right.size(); ++p) work_.segment<6>(6 * place_[p]) = right[p];
  work_ = factor_.solve(work_);
  solution.resize(right.size());
  for (std::size_t p = 0; p < right.size(); ++p) solution[p] = work_.segment<6>(6 * place_[p]);
}

}  // namespace crumble::dryer

#include "common/hydro/dense_kernels.hpp"

#include <omp.h>

#include <algorithm>

namespace crumble::dense {

namespace {
constexpr Eigen::Index tile = 192;
}

int threads_for(Eigen::Index n) { return n < threads_pay_from || omp_in_parallel() ? 1 : omp_get_max_threads(); }

template <class Scalar>
int cholesky(Block<Scalar> a) {
  const Eigen::Index n = a.rows();
  const int threads = threads_for(n);
  for (Eigen::Index k = 0; k < n; k += tile) {
    const Eigen::Index width = std::min(tile, n - k), below = n - k - width, tiles = (below + tile - 1) / tile;
    auto corner = a.block(k, k, width, width);
    if (const Eigen::Index minor = Eigen::internal::llt_inplace<Scalar, Eigen::Lower>::blocked(corner); minor >= 0)
      return static_cast<int>(k + minor + 1);
    const auto rows = [&](Eigen::Index i) { return std::min(tile, below - i * tile); };
    const auto panel = [&](Eigen::Index i) { return a.block(k + width + i * tile, k, rows(i), width); };
#pragma omp parallel num_threads(threads)
    {
#pragma omp for schedule(dynamic)
      for (Eigen::Index i = 0; i < tiles; ++i) {
        auto side = panel(i);
        corner.template triangularView<Eigen::Lower>().transpose().template solveInPlace<Eigen::OnTheRight>(side);
      }
#pragma omp for schedule(dynamic) collapse(2)
      for (Eigen::Index i = 0; i < tiles; ++i)
        for (Eigen::Index j = 0; j < tiles; ++j)
          if (j < i)
            a.block(k + width + i * tile, k + width + j * tile, rows(i), rows(j)).noalias() -=
                panel(i) * panel(j).transpose();
          else if (j == i)
            a.block(k + width + i * tile, k + width + i * tile, rows(i), rows(i))
                .template selfadjointView<Eigen::Lower>()
                .rankUpdate(panel(i), Scalar(-1));
    }
  }
  return 0;
}

template <class Scalar>
void solve(const ConstBlock<Scalar>& a, Block<Scalar> b) {
  if (b.cols() == 1) {
    auto column = b.col(0);
    a.template triangularView<Eigen::Lower>().solveInPlace(column);
  } else {
    a.template triangularView<Eigen::Lower>().solveInPlace(b);
  }
}

template <class Scalar>
void solve_transposed(const ConstBlock<Scalar>& a, Block<Scalar> b) {
  if (b.cols() == 1) {
    auto column = b.col(0);
    a.template triangularView<Eigen::Lower>().transpose().solveInPlace(column);
  } else {
    a.template triangularView<Eigen::Lower>().transpose().solveInPlace(b);
  }
}

template int cholesky<float>(Block<float>);
template int cholesky<double>(Block<double>);
template void solve<float>(const ConstBlock<float>&, Block<float>);
template void solve<double>(const ConstBlock<double>&, Block<double>);
template void solve_transposed<float>(const ConstBlock<float>&, Block<float>);
template void solve_transposed<double>(const ConstBlock<double>&, Block<double>);

}  // namespace crumble::dense

#include "common/hydro/dense_kernels.hpp"

#include <omp.h>

#include <algorithm>

#include "common/hydro/dense_tiles.hpp"

namespace crumble::dense {

namespace {

constexpr Eigen::Index tile = 192;

template <class Library, class Scalar>
int tiled_cholesky(Block<Scalar> a) {
  const Eigen::Index n = a.rows();
  if (n < threads_pay_from) return Library::cholesky(a);
  const int threads = threads_for(n);
  for (Eigen::Index k = 0; k < n; k += tile) {
    const Eigen::Index width = std::min(tile, n - k), below = n - k - width, tiles = (below + tile - 1) / tile;
    auto corner = a.block(k, k, width, width);
    if (const int minor = Library::cholesky(corner); minor != 0) return static_cast<int>(k) + minor;
    const auto rows = [&](Eigen::Index i) { return std::min(tile, below - i * tile); };
    const auto panel = [&](Eigen::Index i) { return a.block(k + width + i * tile, k, rows(i), width); };
    const auto block = [&](Eigen::Index i, Eigen::Index j) {
      return a.block(k + width + i * tile, k + width + j * tile, rows(i), rows(j));
    };
#pragma omp parallel num_threads(threads)
    {
#pragma omp for schedule(dynamic)
      for (Eigen::Index i = 0; i < tiles; ++i) Library::solve_right(corner, panel(i));
#pragma omp for schedule(dynamic) collapse(2)
      for (Eigen::Index i = 0; i < tiles; ++i)
        for (Eigen::Index j = 0; j < tiles; ++j)
          if (j < i)
            Library::subtract_outer(block(i, j), panel(i), panel(j));
          else if (j == i)
            Library::subtract_square(block(i, i), panel(i));
    }
  }
  return 0;
}

// work(library), with the static functions of one of the two.
template <class Scalar, class Work>
auto with(Kernels by, const Work& work) {
  return by == Kernels::openblas ? work(OpenBlasKernels<Scalar>()) : work(EigenKernels<Scalar>());
}

}  // namespace

int threads_for(Eigen::Index n) { return n < threads_pay_from || omp_in_parallel() ? 1 : omp_get_max_threads(); }

template <class Scalar>
int cholesky(Block<Scalar> a, Kernels by) {
  return with<Scalar>(by, [&]<class Library>(Library) { return tiled_cholesky<Library, Scalar>(a); });
}

template <class Scalar>
void solve(const ConstBlock<Scalar>& a, Block<Scalar> b, Kernels by) {
  with<Scalar>(by, [&](auto library) { library.solve(a, b); });
}

template <class Scalar>
void solve_transposed(const ConstBlock<Scalar>& a, Block<Scalar> b, Kernels by) {
  with<Scalar>(by, [&](auto library) { library.solve_transposed(a, b); });
}

template <class Scalar>
void multiply_add(Block<Scalar> c, Scalar sign, const ConstBlock<Scalar>& a, const ConstBlock<Scalar>& b, Kernels by) {
  with<Scalar>(by, [&](auto library) { library.multiply_add(c, sign, a, b); });
}

template <class Scalar>
void multiply_add_transposed(Block<Scalar> c, Scalar sign, const ConstBlock<Scalar>& a, const ConstBlock<Scalar>& b,
                             Kernels by) {
  with<Scalar>(by, [&](auto library) { library.multiply_add_transposed(c, sign, a, b); });
}

template <class Scalar>
void invert_from_factor(Block<Scalar> a, Kernels by) {
  with<Scalar>(by, [&](auto library) { library.invert_from_factor(a); });
  a.template triangularView<Eigen::StrictlyUpper>() = a.transpose();
}

#define CRUMBLE_INSTANTIATE(Scalar)                                                                               \
  template int cholesky<Scalar>(Block<Scalar>, Kernels);                                                          \
  template void solve<Scalar>(const ConstBlock<Scalar>&, Block<Scalar>, Kernels);                                 \
  template void solve_transposed<Scalar>(const ConstBlock<Scalar>&, Block<Scalar>, Kernels);                      \
  template void multiply_add<Scalar>(Block<Scalar>, Scalar, const ConstBlock<Scalar>&, const ConstBlock<Scalar>&, \
                                     Kernels);                                                                    \
  template void multiply_add_transposed<Scalar>(Block<Scalar>, Scalar, const ConstBlock<Scalar>&,                 \
                                                const ConstBlock<Scalar>&, Kernels);                              \
  template void invert_from_factor<Scalar>(Block<Scalar>, Kernels);
CRUMBLE_INSTANTIATE(float)
CRUMBLE_INSTANTIATE(double)
#undef CRUMBLE_INSTANTIATE

}  // namespace crumble::dense

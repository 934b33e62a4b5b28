// OpenBLAS against Eigen on one thread, as the processor and the level of the build have them:
//
//   bench_dense_kernels [orders]
//
// Prints the rows of the table in common/hydro/NOTEBOOK.md. Milliseconds of processor time, the shortest of several
// runs; the difference is that of the factors, relative, in the Frobenius norm.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "common/hydro/dense_kernels.hpp"

using namespace crumble;
using blas::Kernels;

namespace {

double now() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

template <class Before, class Work>
double shortest(const Before& before, const Work& work) {
  double best = 1e300, total = 0;
  for (int k = 0; k < 30 && (k < 3 || total < 300); ++k) {
    before();
    const double begin = now();
    work();
    const double t = now() - begin;
    best = std::min(best, t);
    total += t;
  }
  return best;
}

template <class Scalar>
void row(int n) {
  using M = dense::Matrix<Scalar>;
  const M b = M::Random(n, n);
  M a = M::Identity(n, n), work, factor[2], product = M::Zero(n, n);
  a.template selfadjointView<Eigen::Lower>().rankUpdate(b, Scalar(1) / Scalar(n));
  double cholesky[2], inverse[2], multiplied[2];
  for (const Kernels by : {Kernels::openblas, Kernels::eigen}) {
    const int k = static_cast<int>(by);
    cholesky[k] = shortest([&] { work = a; }, [&] { dense::cholesky<Scalar>(work, by); });
    factor[k] = work.template triangularView<Eigen::Lower>();
    inverse[k] = shortest([&] { work = factor[k]; }, [&] { dense::invert_from_factor<Scalar>(work, by); });
    multiplied[k] = shortest([] {}, [&] { dense::multiply_add<Scalar>(product, 1, b, b, by); });
  }
  const auto pair = [](const double* t) {
    return fmt::format("{:.3g} / {:.3g}", t[static_cast<int>(Kernels::openblas)], t[static_cast<int>(Kernels::eigen)]);
  };
  fmt::print("| {} | {} | {} | {} | {} | {:.0e} |\n", n, sizeof(Scalar) == 4 ? "float" : "double", pair(cholesky),
             pair(inverse), pair(multiplied), (factor[0] - factor[1]).norm() / factor[1].norm());
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> orders;
  for (int k = 1; k < argc; ++k) orders.push_back(std::atoi(argv[k]));
  if (orders.empty()) orders = {690, 935, 1265};
  fmt::print("{}; Eigen for {} ({} bytes)\n\n", blas::description(), Eigen::SimdInstructionSetsInUse(),
             EIGEN_MAX_STATIC_ALIGN_BYTES);
  fmt::print("| order | precision | Cholesky | inverse | product | difference |\n|---|---|---|---|---|---|\n");
  for (const int n : orders) {
    row<double>(n);
    row<float>(n);
  }
}

// OpenBLAS and Eigen by the same names, whichever is taken on the machine.
#include "common/hydro/dense_kernels.hpp"

#include <cblas.h>
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace crumble;
using blas::Kernels;

namespace {

template <class Scalar>
using Matrix = dense::Matrix<Scalar>;

template <class Scalar>
Matrix<Scalar> random(Eigen::Index rows, Eigen::Index columns) {
  std::mt19937 generator(static_cast<unsigned>(17 * rows + columns));
  Matrix<Scalar> m(rows, columns);
  // Not a distribution of the standard library, whose numbers differ from one to the next.
  for (Scalar& v : m.reshaped()) v = static_cast<Scalar>(2.0 * static_cast<double>(generator()) / 4294967295.0 - 1);
  return m;
}

// Symmetric positive definite, eigenvalues from 1 to less than 30: identity and squares of up to 50 columns.
template <class Scalar>
Matrix<Scalar> random_spd(Eigen::Index n) {
  const Eigen::Index columns = std::min<Eigen::Index>(n, 50);
  const Matrix<Scalar> b = random<Scalar>(n, columns);
  Matrix<Scalar> a = Matrix<Scalar>::Identity(n, n);
  a.template selfadjointView<Eigen::Lower>().rankUpdate(b, Scalar(1) / Scalar(columns));
  return a.template selfadjointView<Eigen::Lower>();
}

// Errors of sums of n products are below n eps in the norm; well-conditioned matrices multiply it by a few.
template <class Scalar>
double bound(Eigen::Index n) {
  return 20 * static_cast<double>(n + 10) * std::numeric_limits<Scalar>::epsilon();
}

template <class Scalar>
class DenseKernels : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(DenseKernels, Scalars);

// Where OpenBLAS does not know the processor no program takes it, and its fallback may crash (strsm of core Prescott on
// a processor with AVX-512): Eigen stands in its place.
const Kernels both[] = {Kernels::eigen, blas::kernels_for(openblas_get_corename(), 32)};
// Below, at and above a tile of 192, and (last) above the order from which the factor goes by tiles.
constexpr int orders[] = {1, 2, 63, 191, 192, 193, 345, 2011};

}  // namespace

TYPED_TEST(DenseKernels, FactorsMultiplyToTheMatrix) {
  using M = Matrix<TypeParam>;
  for (const int n : orders) {
    const M a = random_spd<TypeParam>(n);
    M factor[2];
    for (const Kernels by : both) {
      M& l = factor[static_cast<int>(by)] = a;
      ASSERT_EQ(dense::cholesky<TypeParam>(l, by), 0);
      l.template triangularView<Eigen::StrictlyUpper>().setZero();
      const M x = random<TypeParam>(n, 1), product = l * (l.transpose() * x);
      EXPECT_LT((product - a * x).norm(), bound<TypeParam>(n) * a.norm()) << n;
    }
    EXPECT_LT((factor[0] - factor[1]).norm(), bound<TypeParam>(n) * factor[0].norm()) << n;
  }
}

TYPED_TEST(DenseKernels, FirstMinorThatIsNotPositiveDefiniteIsNamed) {
  for (const Kernels by : both)
    for (const int n : {345, 2011}) {
      Matrix<TypeParam> a = random_spd<TypeParam>(n);
      a(n - 20, n - 20) = -1;
      EXPECT_EQ(dense::cholesky<TypeParam>(a, by), n - 19);
    }
}

// On one thread and on three, and inside a parallel region.
TYPED_TEST(DenseKernels, FactorsAreTheSameBitsWithAnyNumberOfThreads) {
  const int before = omp_get_max_threads();
  const Matrix<TypeParam> a = random_spd<TypeParam>(2011);
  for (const Kernels by : both) {
    Matrix<TypeParam> one = a, three = a, inside = a;
    omp_set_num_threads(1);
    dense::cholesky<TypeParam>(one, by);
    omp_set_num_threads(3);
    dense::cholesky<TypeParam>(three, by);
    EXPECT_EQ(omp_get_max_threads(), 3);
#pragma omp parallel num_threads(2)
#pragma omp single
    dense::cholesky<TypeParam>(inside, by);
    omp_set_num_threads(before);
    for (auto* l : {&one, &three, &inside}) l->template triangularView<Eigen::StrictlyUpper>().setZero();
    EXPECT_EQ(one, three);
    EXPECT_EQ(one, inside);
  }
}

TYPED_TEST(DenseKernels, SolvesAndProductsFulfilTheirEquations) {
  using M = Matrix<TypeParam>;
  for (const Kernels by : both)
    for (const int n : {1, 63, 193, 345})
      for (const int columns : {1, 11}) {
        // Corners of larger matrices, as the callers have them.
        M large = random_spd<TypeParam>(n + 5);
        ASSERT_EQ(dense::cholesky<TypeParam>(large, by), 0);
        const auto a = large.topLeftCorner(n, n);
        const M l = a.template triangularView<Eigen::Lower>(), b = random<TypeParam>(n, columns);
        M x = b, y = b;
        dense::solve<TypeParam>(a, x, by);
        dense::solve_transposed<TypeParam>(a, y, by);
        EXPECT_LT((l * x - b).norm(), bound<TypeParam>(n) * b.norm());
        EXPECT_LT((l.transpose() * y - b).norm(), bound<TypeParam>(n) * b.norm());

        const M c = random<TypeParam>(n + 7, n), d = random<TypeParam>(n + 7, columns);
        M sum = d, transposed = b;
        dense::multiply_add<TypeParam>(sum, -1, c, b, by);
        dense::multiply_add_transposed<TypeParam>(transposed, 2, c, d, by);
        const double scale = bound<TypeParam>(n) * c.norm();
        EXPECT_LT((sum - (d - (c * b).eval())).norm(), scale * b.norm());
        EXPECT_LT((transposed - (b + 2 * (c.transpose() * d).eval())).norm(), scale * d.norm());
      }
}

TYPED_TEST(DenseKernels, InverseFromTheFactor) {
  using M = Matrix<TypeParam>;
  for (const Kernels by : both)
    for (const int n : {1, 63, 64, 65, 130, 345}) {
      const M a = random_spd<TypeParam>(n);
      M inverse = a;
      ASSERT_EQ(dense::cholesky<TypeParam>(inverse, by), 0);
      dense::invert_from_factor<TypeParam>(inverse, by);
      EXPECT_EQ(inverse, M(inverse.transpose()));
      EXPECT_LT((a * inverse - M::Identity(n, n)).norm(), bound<TypeParam>(n) * std::sqrt(n)) << n;
    }
}

// The rule by the names that OpenBLAS gives its kernels; bytes of a register of Eigen's: 16 SSE, 32 AVX, 64 AVX-512.
TEST(Blas, KernelFollowsFromNameAndLevel) {
#if defined(__aarch64__)
  for (const char* core : {"armv8", "neoversen1", "neoversev1", "cortexa72"})
    EXPECT_EQ(blas::kernels_for(core, 16), Kernels::openblas) << core;
#else
  for (const char* core : {"Haswell", "Zen", "SkylakeX", "Cooperlake", "Sapphirerapids", "SAPPHIRERAPIDS"}) {
    EXPECT_EQ(blas::kernels_for(core, 16), Kernels::openblas) << core;
    EXPECT_EQ(blas::kernels_for(core, 32), Kernels::openblas) << core;
    EXPECT_EQ(blas::kernels_for(core, 64), Kernels::eigen) << core;
  }
  for (const char* core : {"Prescott", "Core2", "Nehalem", "Sandybridge", "Barcelona", "Piledriver", "unknown", ""})
    for (const int bytes : {0, 16, 32, 64}) EXPECT_EQ(blas::kernels_for(core, bytes), Kernels::eigen) << core;
#endif
}

TEST(Blas, DescriptionNamesLibraryKernelAndChoice) {
  const std::string text = blas::description();
  EXPECT_TRUE(text.starts_with("OpenBLAS 0.")) << text;
  EXPECT_NE(text.find(", core "), text.npos) << text;
  EXPECT_EQ(text.ends_with(", used"), blas::kernels() == Kernels::openblas) << text;
  EXPECT_EQ(text.ends_with(": Eigen's kernels instead"), blas::kernels() == Kernels::eigen) << text;
}

#include "common/numerics/simd.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

using namespace crumble;

namespace {

// 1.5, 2.5, ...
template <class T, std::size_t N>
Simd<T, N> counted() {
  std::array<T, N> at;
  std::iota(at.begin(), at.end(), T(1.5));
  return Simd<T, N>::load(at.data());
}

template <class Numbers>
class SimdOf : public testing::Test {};
using Kinds = testing::Types<Simd<float>, Simd<double>, Simd<float, 4>, Simd<float, 8>, Simd<double, 4>>;
TYPED_TEST_SUITE(SimdOf, Kinds);

TYPED_TEST(SimdOf, operators_are_those_of_every_single_number) {
  using T = std::remove_cvref_t<decltype(TypeParam()[0])>;
  constexpr std::size_t N = TypeParam::size;
  const TypeParam x = counted<T, N>(), y = T(7.25) - x;
  std::array<T, N> stored;
  (x * y).store(stored.data());
  T sum = 0, least = x[0] - x[0], largest = least;
  for (std::size_t k = 0; k < N; ++k) {
    const T a = T(k) + T(1.5), b = T(7.25) - a;
    EXPECT_EQ(x[k], a);
    EXPECT_EQ((x + y)[k], T(7.25));
    EXPECT_EQ(stored[k], a * b);
    EXPECT_EQ((y / x)[k], b / a);
    EXPECT_EQ((-x)[k], -a);
    EXPECT_EQ(min(x, y)[k], std::min(a, b));
    EXPECT_EQ(max(x, y)[k], std::max(a, b));
    EXPECT_EQ(sqrt(x)[k], std::sqrt(a));
    EXPECT_EQ(where_greater(x, y, x, 0)[k], a > b ? a : 0);
    sum += b;
    least = k == 0 ? b : std::min(least, b);
    largest = k == 0 ? b : std::max(largest, b);
  }
  EXPECT_EQ(y.sum(), sum);  // exact: multiples of a quarter
  EXPECT_EQ(y.least(), least);
  EXPECT_EQ(y.largest(), largest);
}

TEST(Simd, the_inverse_root_is_right_in_single_precision_over_all_lengths) {
  for (float x = 1e-36f; x < 1e36f; x *= 1.37f)
    EXPECT_NEAR(inverse_sqrt(Simd<float>(x))[0] * std::sqrt(static_cast<double>(x)), 1, 4e-7) << x;
}

TEST(Simd, numbers_pass_between_precisions_and_halves_in_their_order) {
  const auto four = counted<double, 4>();
  const auto single = convert<float>(four);
  const auto again = convert<double>(single);
  const auto both = joined(single, -single);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(single[k], static_cast<float>(four[k]));
    EXPECT_EQ(again[k], four[k]);
    EXPECT_EQ(both[k], single[k]);
    EXPECT_EQ(both[4 + k], -single[k]);
    EXPECT_EQ(lower_half(both)[k], single[k]);
  }
}

}  // namespace

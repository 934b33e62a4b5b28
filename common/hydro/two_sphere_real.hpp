// The extended-precision number in which the two-sphere reference solution is computed.
#pragma once

#include <cmath>

#if defined(__x86_64__) || defined(__i386__)
#include <quadmath.h>
#endif

namespace crumble::two_sphere {

// 113-bit mantissa: __float128 on x86; on arm64 Linux long double already is that format. Needed because a sphere
// at separation s cancels s^3 in its torque and stresslet, and a gap of 1e-7 cancels 1e7 in the near-field remainder.
#if defined(__x86_64__) || defined(__i386__)
__extension__ using Real = __float128;
inline Real real_exp(Real x) { return expq(x); }
inline Real real_expm1(Real x) { return expm1q(x); }
inline Real real_log(Real x) { return logq(x); }
inline Real real_log1p(Real x) { return log1pq(x); }
inline Real real_sqrt(Real x) { return sqrtq(x); }
inline Real real_cos(Real x) { return cosq(x); }
inline Real real_pi() { return acosq(-1); }
#else
using Real = long double;
inline Real real_exp(Real x) { return std::exp(x); }
inline Real real_expm1(Real x) { return std::expm1(x); }
inline Real real_log(Real x) { return std::log(x); }
inline Real real_log1p(Real x) { return std::log1p(x); }
inline Real real_sqrt(Real x) { return std::sqrt(x); }
inline Real real_cos(Real x) { return std::cos(x); }
inline Real real_pi() { return std::acos(Real(-1)); }
#endif

}  // namespace crumble::two_sphere

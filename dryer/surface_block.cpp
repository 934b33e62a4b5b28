#include "dryer/surface_block.hpp"

#include <hwy/contrib/math/math-inl.h>

#include "dryer/jkr_root.hpp"

namespace crumble::dryer {

void SurfaceBlock::begin(const SurfaceForceLaws& laws) {
  count_ = 0;
  kappa_ = static_cast<float>(laws.kappa());
  range_ = static_cast<float>(laws.range());
  hamaker_ = static_cast<float>(laws.forces().hamaker);
  retardation_ = static_cast<float>(retardation_rate(laws.forces().retardation_wavelength));
  for (auto* array : {&i_, &j_}) array->clear();
  for (auto* array : {&sum_, &product_, &joined_, &lost_, &inverse_length_, &pull_off_, &strength_, &open_})
    array->clear();
}

void SurfaceBlock::add(std::int32_t i, std::int32_t j, const PairForces& forces, double a_i, double a_j, bool bonded) {
  // The lanes beyond the last pair repeat one.
  const auto put = [&](auto& array, auto value) {
    using Number = typename std::decay_t<decltype(array)>::value_type;
    if (array.size() == count_) array.resize(count_ + lanes, static_cast<Number>(value));
    array[count_] = static_cast<Number>(value);
  };
  const JoinedAttraction& attraction = forces.attraction;
  put(i_, i);
  put(j_, j);
  put(sum_, a_i + a_j);
  put(product_, 2 * a_i * a_j);
  put(joined_, attraction.joined_gap());
  put(lost_, attraction.lost_gap());
  put(inverse_length_, 1 / attraction.contact().jkr.length);
  put(pull_off_, attraction.contact().pull_off_force());
  put(strength_, forces.repulsion.strength);
  put(open_, bonded ? 0 : 1);
  ++count_;
}

// dU/dh: DoubleLayer::tension, VanDerWaals::tension from h_j on, Jkr up to h_po.
HWY_INLINE Lane SurfaceBlock::tension(std::size_t b, const Lane& squared, const Lane& inverse) const {
  const auto at = [b](const AlignedVector<float>& array) __attribute__((always_inline)) {
    return Lane::load(&array[b]);
  };
  const Lane sum = at(sum_), distance = squared * inverse, gap = (squared - sum * sum) / (distance + sum);
  const Lane apart = max(gap, Lane(0)), per_r = min(inverse, 1 / sum);
  const Lane faded = hn::Exp(Lane::Tag(), (-(kappa_ * apart)).at[0]);
  const Lane repulsion = -at(strength_) * per_r * faded * (kappa_ + per_r);
  if (hamaker_ == 0) return where_greater(range_, gap, repulsion, 0);
  // (4 A/3) p^3 r/(s d)^2 in factors that stay within single precision.
  const Lane lost = at(lost_), h = max(gap, at(joined_)), p = at(product_), s = h * (2 * sum + h);
  const Lane per_d = 1 / (s + 2 * p), near = p / s, share = p * per_d;
  Lane attraction = (4.0f / 3 * hamaker_) * near * near * share * (sum + h) * per_d;
  if (retardation_ > 0) {
    const Lane factor = 1 / (1 + retardation_ * h);
    const Lane logarithm = hn::Log(Lane::Tag(), (s * per_d).at[0]);
    attraction = factor * (attraction + hamaker_ / 6 * (near + share + logarithm) * retardation_ * factor);
  }
  if (((gap - lost) * at(open_)).least() < 0) {
    const Lane root = jkr_root(min(gap, lost) * at(inverse_length_)), cubed = root * root * root;
    attraction = where_greater(gap, lost, attraction, 4 * at(pull_off_) * cubed * (1 - cubed));
  }
  return where_greater(range_, gap, repulsion + at(open_) * attraction, 0);
}

void SurfaceBlock::add_forces(const Position* position, Quad* force) const {
  Quad apart[lanes];
  float pull[lanes];
  for (std::size_t b = 0; b < count_; b += lanes) {
    const LaneVector D =
        from_quarters([&](std::size_t l) { return apart[l] = difference(position[i_[b + l]], position[j_[b + l]]); });
    const Lane squared = dot(D, D), inverse = inverse_sqrt(squared);
    (tension(b, squared, inverse) * inverse).store(pull);
    for (std::size_t l = 0; l < std::min(lanes, count_ - b); ++l) {
      const Quad on_j = Quad(pull[l]) * apart[l];
      force[j_[b + l]] += on_j;
      force[i_[b + l]] = force[i_[b + l]] - on_j;
    }
  }
}

}  // namespace crumble::dryer

#include "dryer/bond_block.hpp"

#include <algorithm>
#include <cmath>

namespace crumble {

namespace {

// Displacement at which a spring yields; 1e100 without limit.
double farthest(double limit, double stiffness) { return stiffness == 0 ? 0 : std::min(limit / stiffness, 1e100); }

}  // namespace

void MotionBlock::resize(std::size_t count) {
  for (Triple* field : {&position, &rotation, &force, &torque})
    for (auto& array : *field) array.assign(padded(count), 0);
}

template <class Visit>
void BondBlock::each_array(Visit visit) {
  for (Triple* triple : {&normal_, &sliding_, &rolling_, &apart_, &turn_i_, &turn_j_})
    for (auto& array : *triple) visit(array);
  for (auto* scalar : {&twisting_, &gap_, &lost_gap_}) visit(*scalar);
  for (auto& array : constants_) visit(array);
}

void BondBlock::clear() {
  count_ = 0;
  i_.clear();
  j_.clear();
  born_.clear();
  each_array([](std::vector<double>& array) { array.clear(); });
  deepest_ = 0;
}

void BondBlock::add(const Contact& bond, std::int32_t i, std::int32_t j, const BondLaw& law, double a_i, double a_j,
                    double lost_gap) {
  // The lanes beyond the last bond repeat one, so that they compute nothing harmful.
  const auto put = [&](auto& array, auto value) {
    if (array.size() == count_) array.resize(count_ + lanes, value);
    array[count_] = value;
  };
  put(i_, i);
  put(j_, j);
  put(born_, bond.born);
  for (int k = 0; k < 3; ++k) {
    put(normal_[k], bond.normal[k]);
    put(sliding_[k], bond.sliding[k]);
    put(rolling_[k], bond.rolling[k]);
    for (Triple* each : {&apart_, &turn_i_, &turn_j_}) put((*each)[k], 0.0);
  }
  put(twisting_, bond.twisting);
  put(gap_, bond.gap);
  put(lost_gap_, lost_gap);
  const std::array<double, constant_count> value = {a_i,
                                                    a_j,
                                                    1 / (a_i + a_j),
                                                    1 / law.jkr.length,
                                                    law.jkr.pull_off_force,
                                                    law.k_s,
                                                    law.k_t,
                                                    law.k_r,
                                                    farthest(law.F_s_crit, law.k_s),
                                                    farthest(law.M_t_crit, law.k_t),
                                                    farthest(law.M_r_crit, law.k_r)};
  if (count_ == 0) uniform_ = true;
  for (std::size_t c = 0; c < constant_count; ++c) {
    put(constants_[c], value[c]);
    uniform_ = uniform_ && value[c] == constants_[c][0];
  }
  ++count_;
}

void BondBlock::remove(std::size_t bond) {
  --count_;
  const auto drop = [&](auto& array) { array[bond] = array[count_]; };
  drop(i_);
  drop(j_);
  drop(born_);
  each_array(drop);
}

void BondBlock::store(std::size_t b, Contact& contact) const {
  for (int k = 0; k < 3; ++k) {
    contact.normal[k] = normal_[k][b];
    contact.sliding[k] = sliding_[k][b];
    contact.rolling[k] = rolling_[k][b];
  }
  contact.twisting = twisting_[b];
  contact.gap = gap_[b];
  contact.born = born_[b];
}

namespace {

using Lane = Eigen::Array<double, lanes, 1>;

struct V {
  Lane x, y, z;
};
inline V operator+(const V& a, const V& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline V operator-(const V& a, const V& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline V operator*(const Lane& s, const V& a) { return {s * a.x, s * a.y, s * a.z}; }
inline Lane dot(const V& a, const V& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline V cross(const V& a, const V& b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }

inline Lane read(const std::vector<double>& array, std::size_t first) { return Eigen::Map<const Lane>(&array[first]); }
inline V read(const Triple& array, std::size_t first) {
  return {read(array[0], first), read(array[1], first), read(array[2], first)};
}
inline void write(std::vector<double>& array, std::size_t first, const Lane& value) {
  Eigen::Map<Lane> to(&array[first]);
  to = value;
}
inline void write(Triple& array, std::size_t first, const V& value) {
  write(array[0], first, value.x);
  write(array[1], first, value.y);
  write(array[2], first, value.z);
}
// Factor that brings a spring of a given displacement back to its limit, 1 if within.
inline Lane cap(const Lane& squared, const Lane& limit) { return (limit * squared.max(1e-300).rsqrt()).min(1); }

// Root c of x = h/L = (4 c - 6 c^4)/3 (common/contact/jkr.hpp): a polynomial in w = sqrt(x_f - x), x_f where the branch
// folds back, fitted to 8e-6 from pull-off to x = -5.7 (nine times the equilibrium gap), and one step of Newton, which
// leaves 7e-9 of the force. Beyond, where 2 c^4 is -x and a little more, four steps.
inline Lane jkr_root(const Lane& x) {
  constexpr double fold = 0.5503212081491045, fitted = 2.5;
  const Lane below = fold - x, w = below * below.rsqrt();
  Lane c = 0.5528552459233961 +
           w * (0.5095706658630831 +
                w * (-0.12938254570964916 +
                     w * (0.039660843000896 + w * (-0.008106851135392574 + w * 0.0007488885619162906))));
  const auto newton = [&] {
    const Lane cubed = c * c * c;
    c -= (4 * c - 6 * c * cubed - 3 * x) / (4 - 24 * cubed);
  };
  newton();
  if ((w > fitted).any()) {
    c = (w > fitted).select((0.75 * below).sqrt().sqrt(), c);
    for (int step = 0; step < 4; ++step) newton();
  }
  return c;
}

}  // namespace

// In loops of their own, which the compiler can make gathers of.
void BondBlock::follow(const MotionBlock& motion) {
  const std::size_t count = padded(count_);
  const std::int32_t *i = i_.data(), *j = j_.data();
  for (int k = 0; k < 3; ++k) {
    const double *x = motion.position[k].data(), *w = motion.rotation[k].data();
    double *apart = apart_[k].data(), *turn_i = turn_i_[k].data(), *turn_j = turn_j_[k].data();
#pragma omp simd
    for (std::size_t b = 0; b < count; ++b) apart[b] = x[j[b]] - x[i[b]];
#pragma omp simd
    for (std::size_t b = 0; b < count; ++b) turn_i[b] = w[i[b]];
#pragma omp simd
    for (std::size_t b = 0; b < count; ++b) turn_j[b] = w[j[b]];
  }
}

// Of `lanes` bonds from b on, in one go from positions to loads: what is needed only in between stays in registers, and
// what is read of a few hundred bonds in the fastest cache.
BondBlock::Loads BondBlock::move(std::size_t b) {
  const auto constant = [&](Constant which) { return read(constants_[which], uniform_ ? 0 : b); };
  const V Wi = read(turn_i_, b), Wj = read(turn_j_, b), W = Wj - Wi, D = read(apart_, b);
  const Lane a_i = constant(radius_i), a_j = constant(radius_j), reach = a_i + a_j;
  const Lane squared = dot(D, D), inverse = squared.rsqrt(), distance = squared * inverse, gap = distance - reach;
  const V n0 = read(normal_, b), n = inverse * D, sum = n0 + n, moved = D - (reach + read(gap_, b)) * n0;
  // The normal turns little in a step: 1/|sum| and 1/(1 + n0 n) to second order in 1 - n0 n.
  const Lane bend = 1 - dot(n0, n), half = 0.5 + bend * (0.25 + 0.125 * bend);
  const V mid = (0.5 + bend * (0.125 + 0.046875 * bend)) * sum;
  const Lane stretch = distance * constant(inverse_reach);
  const V arm = stretch * (a_i * Wi + a_j * Wj);
  const Lane twist = dot(mid, W);
  const V slide = moved - dot(mid, moved) * mid - cross(arm, mid), roll = W - twist * mid;
  // Carried along: the smallest rotation from n0 to n, then the mean spin about n (sine and cosine to third order).
  const Lane spin = 0.5 * dot(mid, Wi + Wj), s = spin * (1 - spin * spin / 6), c = 1 - 0.5 * spin * spin;
  const auto carry = [&](const V& history, const V& increase) __attribute__((always_inline)) {
    const V v = history - (half * dot(n, history)) * sum, carried = c * v + s * cross(n, v) + increase;
    return carried - dot(n, carried) * n;
  };
  V sliding = carry(read(sliding_, b), slide), rolling = carry(read(rolling_, b), roll);
  sliding = cap(dot(sliding, sliding), constant(most_sliding)) * sliding;
  rolling = cap(dot(rolling, rolling), constant(most_rolling)) * rolling;
  const Lane most = constant(most_twisting), twisting = (read(twisting_, b) + twist).min(most).max(-most);
  write(normal_, b, n);
  write(sliding_, b, sliding);
  write(rolling_, b, rolling);
  write(twisting_, b, twisting);
  write(gap_, b, gap);

  const Lane root = jkr_root(gap.min(read(lost_gap_, b)) * constant(inverse_length)), cubed = root * root * root;
  const Lane tension = 4 * constant(pull_off) * cubed * (1 - cubed);
  const V F = -constant(k_s) * sliding;
  const V M = (-constant(k_t) * twisting) * n - constant(k_r) * rolling;
  const V turn = stretch * cross(n, F), force = F - tension * n, on_i = Lane::Constant(-1) * (M + a_i * turn),
          on_j = M - a_j * turn;
  return {{force.x, force.y, force.z}, {on_i.x, on_i.y, on_i.z}, {on_j.x, on_j.y, on_j.z}};
}

void BondBlock::collect(std::size_t first, const Loads& loads, MotionBlock& motion) {
  const std::size_t count = std::min(lanes, count_ - first);
  for (std::size_t l = 0; l < count; ++l) {
    const std::size_t b = first + l;
    if (gap_[b] > lost_gap_[b]) {
      lost_.push_back(static_cast<std::int32_t>(b));
      continue;
    }
    const std::int32_t i = i_[b], j = j_[b];
    const auto lane = static_cast<Eigen::Index>(l);
    for (std::size_t k = 0; k < 3; ++k) {
      motion.force[k][i] -= loads.force[k][lane];
      motion.force[k][j] += loads.force[k][lane];
      motion.torque[k][i] += loads.torque_i[k][lane];
      motion.torque[k][j] += loads.torque_j[k][lane];
    }
    deepest_ = std::max(deepest_, -gap_[b]);
  }
}

void BondBlock::advance(MotionBlock& motion) {
  lost_.clear();
  follow(motion);
  for (std::size_t first = 0; first < count_; first += lanes) collect(first, move(first), motion);
}

}  // namespace crumble

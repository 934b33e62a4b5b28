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
  for (Triple* triple :
       {&separation_, &normal_, &sliding_, &rolling_, &force_, &torque_i_, &torque_j_, &apart_, &turn_i_, &turn_j_})
    for (auto& array : *triple) visit(array);
  for (auto* scalar : {&twisting_, &gap_, &a_i_, &a_j_, &inverse_length_, &inverse_reach_, &pull_off_, &lost_gap_,
                       &k_s_, &k_t_, &k_r_, &most_sliding_, &most_twisting_, &most_rolling_})
    visit(*scalar);
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
    put(separation_[k], (a_i + a_j + bond.gap) * bond.normal[k]);
    put(normal_[k], bond.normal[k]);
    put(sliding_[k], bond.sliding[k]);
    put(rolling_[k], bond.rolling[k]);
    for (Triple* each : {&force_, &torque_i_, &torque_j_, &apart_, &turn_i_, &turn_j_}) put((*each)[k], 0.0);
  }
  put(twisting_, bond.twisting);
  put(gap_, bond.gap);
  put(a_i_, a_i);
  put(a_j_, a_j);
  put(inverse_length_, 1 / law.jkr.length);
  put(inverse_reach_, 1 / (a_i + a_j));
  put(pull_off_, law.jkr.pull_off_force);
  put(lost_gap_, lost_gap);
  put(k_s_, law.k_s);
  put(k_t_, law.k_t);
  put(k_r_, law.k_r);
  put(most_sliding_, farthest(law.F_s_crit, law.k_s));
  put(most_twisting_, farthest(law.M_t_crit, law.k_t));
  put(most_rolling_, farthest(law.M_r_crit, law.k_r));
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

// One vector register of numbers, and vectors of three.
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

void BondBlock::move(std::size_t b) {
  const V D = read(apart_, b), moved = D - read(separation_, b);
  const V Wi = read(turn_i_, b), Wj = read(turn_j_, b), W = Wj - Wi;
  const Lane a_i = read(a_i_, b), a_j = read(a_j_, b), squared = dot(D, D), inverse = squared.rsqrt(),
             distance = squared * inverse;
  const V n0 = read(normal_, b), n = inverse * D, sum = n0 + n;
  // The normal turns little in a step: 1/|sum| and 1/(1 + n0 n) to second order in 1 - n0 n.
  const Lane bend = 1 - dot(n0, n), half = 0.5 + bend * (0.25 + 0.125 * bend);
  const V mid = (0.5 + bend * (0.125 + 0.046875 * bend)) * sum;
  const V arm = (distance * read(inverse_reach_, b)) * (a_i * Wi + a_j * Wj);
  const Lane twist = dot(mid, W);
  const V slide = moved - dot(mid, moved) * mid - cross(arm, mid), roll = W - twist * mid;
  // Carried along: the smallest rotation from n0 to n, then the mean spin about n (sine and cosine to third order).
  const Lane spin = 0.5 * dot(mid, Wi + Wj), s = spin * (1 - spin * spin / 6), c = 1 - 0.5 * spin * spin;
  const auto carry = [&](const V& history, const V& increase) __attribute__((always_inline)) {
    const V v = history - (half * dot(n, history)) * sum, carried = c * v + s * cross(n, v) + increase;
    return carried - dot(n, carried) * n;
  };
  const V sliding = carry(read(sliding_, b), slide), rolling = carry(read(rolling_, b), roll);
  const Lane most = read(most_twisting_, b);
  write(separation_, b, D);
  write(normal_, b, n);
  write(sliding_, b, cap(dot(sliding, sliding), read(most_sliding_, b)) * sliding);
  write(rolling_, b, cap(dot(rolling, rolling), read(most_rolling_, b)) * rolling);
  write(twisting_, b, (read(twisting_, b) + twist).min(most).max(-most));
  write(gap_, b, distance - (a_i + a_j));
}

void BondBlock::load(std::size_t b) {
  const Lane gap = read(gap_, b), c = jkr_root(gap.min(read(lost_gap_, b)) * read(inverse_length_, b));
  const Lane cubed = c * c * c, tension = 4 * read(pull_off_, b) * cubed * (1 - cubed);
  const V n = read(normal_, b);
  const V F = -read(k_s_, b) * read(sliding_, b);
  const V M = (-read(k_t_, b) * read(twisting_, b)) * n - read(k_r_, b) * read(rolling_, b);
  const V turn = (1 + gap * read(inverse_reach_, b)) * cross(n, F);
  write(force_, b, F - tension * n);
  write(torque_i_, b, Lane::Constant(-1) * (M + read(a_i_, b) * turn));
  write(torque_j_, b, M - read(a_j_, b) * turn);
}

void BondBlock::collect(MotionBlock& motion) {
  lost_.clear();
  const std::size_t count = size();
  double shallowest = 0;
  for (std::size_t b = 0; b < count; ++b) {
    if (gap_[b] > lost_gap_[b]) {
      lost_.push_back(static_cast<std::int32_t>(b));
      continue;
    }
    const std::int32_t i = i_[b], j = j_[b];
    for (int k = 0; k < 3; ++k) {
      motion.force[k][i] -= force_[k][b];
      motion.force[k][j] += force_[k][b];
      motion.torque[k][i] += torque_i_[k][b];
      motion.torque[k][j] += torque_j_[k][b];
    }
    shallowest = std::min(shallowest, gap_[b]);
  }
  deepest_ = std::max(deepest_, -shallowest);
}

void BondBlock::advance(MotionBlock& motion) {
  follow(motion);
  for (std::size_t first = 0; first < count_; first += lanes) {
    move(first);
    load(first);
  }
  collect(motion);
}

}  // namespace crumble

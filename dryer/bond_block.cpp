#include "dryer/bond_block.hpp"

#include <algorithm>
#include <cmath>

namespace crumble {

void MotionBlock::resize(std::size_t count) {
  for (Triple* field : {&position, &rotation, &force, &torque})
    for (auto& array : *field) array.assign(padded(count), 0);
}

template <class Visit>
void BondBlock::each_array(Visit visit) {
  for (Triple* triple :
       {&separation_, &normal_, &sliding_, &rolling_, &force_, &torque_i_, &torque_j_, &apart_, &turn_i_, &turn_j_})
    for (auto& array : *triple) visit(array);
  for (auto* scalar :
       {&twisting_, &gap_, &a_i_, &a_j_, &length_, &pull_off_, &lost_gap_, &k_s_, &k_t_, &k_r_, &F_s_, &M_t_, &M_r_})
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
  put(length_, law.jkr.length);
  put(pull_off_, law.jkr.pull_off_force);
  put(lost_gap_, lost_gap);
  put(k_s_, law.k_s);
  put(k_t_, law.k_t);
  put(k_r_, law.k_r);
  put(F_s_, law.F_s_crit);
  put(M_t_, law.M_t_crit);
  put(M_r_, law.M_r_crit);
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
inline Lane cap(const Lane& squared, const Lane& stiffness, const Lane& limit) {
  const Lane force = stiffness * squared.sqrt();
  return force.min(limit) / force.max(1e-300);
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
  const Lane a_i = read(a_i_, b), a_j = read(a_j_, b), reach = a_i + a_j;
  const Lane distance = dot(D, D).sqrt(), h = distance - reach;
  const V n0 = read(normal_, b), n = distance.inverse() * D, sum = n0 + n;
  const V mid = dot(sum, sum).sqrt().inverse() * sum;
  const V arm = (1 + h / reach) * (a_i * Wi + a_j * Wj);
  const Lane twist = dot(mid, W);
  const V slide = moved - dot(mid, moved) * mid - cross(arm, mid), roll = W - twist * mid;
  // Carried along: the smallest rotation from n0 to n, then the mean spin about n (sine and cosine to third order).
  const V axis = cross(n0, n);
  const Lane k = (1 + dot(n0, n)).inverse(), spin = 0.5 * dot(mid, Wi + Wj);
  const Lane s = spin * (1 - spin * spin / 6), c = 1 - 0.5 * spin * spin;
  const auto carry = [&](const V& history) __attribute__((always_inline)) {
    V v = history + cross(axis, history) + k * cross(axis, cross(axis, history));
    v = v - dot(n, v) * n;
    return c * v + s * cross(n, v);
  };
  V sliding = carry(read(sliding_, b)) + slide - dot(n, slide) * n;
  V rolling = carry(read(rolling_, b)) + roll - dot(n, roll) * n;
  const Lane twisting = read(twisting_, b) + twist;
  sliding = cap(dot(sliding, sliding), read(k_s_, b), read(F_s_, b)) * sliding;
  rolling = cap(dot(rolling, rolling), read(k_r_, b), read(M_r_, b)) * rolling;
  write(separation_, b, D);
  write(normal_, b, n);
  write(sliding_, b, sliding);
  write(rolling_, b, rolling);
  write(twisting_, b, cap(twisting * twisting, read(k_t_, b), read(M_t_, b)) * twisting);
  write(gap_, b, h);
}

void BondBlock::load(std::size_t b) {
  const Lane gap = read(gap_, b), reach = read(lost_gap_, b);
  // Root c of h/L = (4 c - 6 c^4)/3 (common/contact/jkr.hpp), from a start within 2 % by three steps of Newton.
  const Lane x = gap.min(reach) / read(length_, b);
  Lane c = (0.5 * (4.0 / 3.0 * (0.9 - 0.12 * x).max(0.85) - x)).sqrt().sqrt();
  for (int step = 0; step < 3; ++step) {
    const Lane cubed = c * c * c;
    c -= (4 * c - 6 * c * cubed - 3 * x) / (4 - 24 * cubed);
  }
  const Lane cubed = c * c * c, tension = 4 * read(pull_off_, b) * cubed * (1 - cubed);
  const V n = read(normal_, b);
  const V F = -read(k_s_, b) * read(sliding_, b);
  const V M = (-read(k_t_, b) * read(twisting_, b)) * n - read(k_r_, b) * read(rolling_, b);
  const Lane a_i = read(a_i_, b), a_j = read(a_j_, b);
  const V turn = (1 + gap / (a_i + a_j)) * cross(n, F);
  write(force_, b, F - tension * n);
  write(torque_i_, b, Lane::Constant(-1) * (M + a_i * turn));
  write(torque_j_, b, M - a_j * turn);
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

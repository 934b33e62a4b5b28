#include "dryer/bond_block.hpp"

#include <algorithm>
#include <cmath>

#include "dryer/jkr_root.hpp"

namespace crumble::dryer {

namespace {

// Displacement at which a spring yields; 1e30 without limit.
double farthest(double limit, double stiffness) { return stiffness == 0 ? 0 : std::min(limit / stiffness, 1e30); }

}  // namespace

void MotionBlock::resize(std::size_t count) {
  position.assign(count, {});
  moved.assign(count, {});
}

template <class Visit>
void BondBlock::each_array(Visit visit) {
  for (auto* array : {&i_, &j_}) visit(*array);
  visit(born_);
  for (auto* triple : {&apart_, &normal_, &sliding_, &rolling_})
    for (auto& array : *triple) visit(array);
  for (auto* scalar : {&twisting_, &gap_, &lost_gap_, &holds_, &slope_, &remembered_}) visit(*scalar);
  if (!uniform_)
    for (auto& array : constants_) visit(array);
}

void BondBlock::clear(std::size_t places, std::size_t expected) {
  count_ = 0;
  // Arrays that grow by themselves take up to twice the memory.
  const std::size_t room = padded(expected + expected / 32 + 1);
  each_array([room](auto& array) {
    array.clear();
    array.reserve(room);
  });
  deepest_ = 0;
  degree_.assign(places, 0);
  links_.assign(places * capacity_, 0);
}

void BondBlock::link(std::int32_t place, std::int32_t end) {
  if (static_cast<std::size_t>(degree_[place]) == capacity_) {
    const std::size_t places = degree_.size(), before = capacity_;
    capacity_ += 4;
    links_.resize(places * capacity_);
    for (std::size_t p = places; p-- > 0;) {
      std::int32_t* links = links_.data() + p * capacity_;
      if (p > 0) std::copy_n(links_.data() + p * before, before, links);
      std::fill(links + before, links + capacity_, 0);
    }
  }
  links_[static_cast<std::size_t>(place) * capacity_ + static_cast<std::size_t>(degree_[place]++)] = end;
}

void BondBlock::unlink(std::int32_t place, std::int32_t end) {
  std::int32_t* links = links_.data() + static_cast<std::size_t>(place) * capacity_;
  *std::find(links, links + degree_[place], end) = links[degree_[place] - 1];
  links[--degree_[place]] = 0;
}

void BondBlock::add(const Contact& bond, std::int32_t i, std::int32_t j, const BondLaw& law, double a_i, double a_j,
                    double lost_gap) {
  // The lanes beyond the last bond repeat one, so that they compute nothing harmful.
  const auto put = [&]<class Array>(Array& array, auto value) {
    using Number = typename Array::value_type;
    if (array.size() == count_) array.resize(count_ + lanes, static_cast<Number>(value));
    array[count_] = static_cast<Number>(value);
  };
  put(i_, i);
  put(j_, j);
  put(born_, bond.born);
  for (int k = 0; k < 3; ++k) {
    put(apart_[k], (a_i + a_j + bond.gap) * bond.normal[k]);
    put(normal_[k], bond.normal[k]);
    put(sliding_[k], bond.sliding[k]);
    put(rolling_[k], bond.rolling[k]);
  }
  put(twisting_, bond.twisting);
  put(gap_, bond.gap);
  put(lost_gap_, lost_gap);
  put(holds_, 1);
  put(slope_, 0);
  put(remembered_, -1);
  const std::array<double, constant_count> value = {a_i,
                                                    a_j,
                                                    a_i + a_j,
                                                    1 / (a_i + a_j),
                                                    1 / law.jkr.length,
                                                    1 / pair_radius(a_i, a_j),
                                                    law.jkr.pull_off_force,
                                                    law.k_s,
                                                    law.k_t,
                                                    law.k_r,
                                                    farthest(law.F_s_crit, law.k_s),
                                                    farthest(law.M_t_crit, law.k_t),
                                                    farthest(law.M_r_crit, law.k_r)};
  if (count_ == 0) {
    uniform_ = true;
    for (std::size_t c = 0; c < constant_count; ++c) constants_[c].assign(lanes, static_cast<float>(value[c]));
  }
  bool same = true;
  for (std::size_t c = 0; c < constant_count; ++c) same = same && static_cast<float>(value[c]) == constants_[c][0];
  if (uniform_ && !same) {
    uniform_ = false;
    for (auto& array : constants_) {
      array.reserve(born_.capacity());
      array.resize(padded(count_), array[0]);
    }
  }
  if (!uniform_)
    for (std::size_t c = 0; c < constant_count; ++c) put(constants_[c], value[c]);
  link(i, end_of(count_, 0));
  link(j, end_of(count_, 1));
  ++count_;
}

void BondBlock::remove(std::size_t bond) {
  const auto unlink_both = [&](std::size_t b) {
    unlink(i_[b], end_of(b, 0));
    unlink(j_[b], end_of(b, 1));
  };
  unlink_both(bond);
  if (bond == --count_) return;
  unlink_both(count_);
  each_array([&](auto& array) { array[bond] = array[count_]; });
  if (end_of(count_, 1) < std::ssize(loads_))
    for (const std::size_t side : {0, 1}) loads_[end_of(bond, side)] = loads_[end_of(count_, side)];
  link(i_[bond], end_of(bond, 0));
  link(j_[bond], end_of(bond, 1));
}

// Gap, normal and histories.
void BondBlock::store(std::size_t b, Contact& contact) const {
  for (int k = 0; k < 3; ++k) {
    contact.normal[k] = normal_[k][b];
    contact.sliding[k] = sliding_[k][b];
    contact.rolling[k] = rolling_[k][b];
  }
  contact.normal.normalize();  // of single precision here; files hold unit vectors to 1e-9
  contact.twisting = twisting_[b];
  contact.gap = gap_[b];
  // A spring that yields ends at its limit, to single precision.
  const std::size_t c = uniform_ ? 0 : b;
  const auto yields = [&](double displacement, Constant stiffness, Constant most) {
    return constants_[stiffness][c] > 0 && displacement > 0 && displacement >= 0.9999 * constants_[most][c];
  };
  contact.at_limit =
      static_cast<std::uint8_t>(yields(contact.sliding.norm(), k_s, most_sliding) * limit::sliding +
                                yields(std::abs(contact.twisting), k_t, most_twisting) * limit::twisting +
                                yields(contact.rolling.norm(), k_r, most_rolling) * limit::rolling);
  contact.born = born_[b];
}

namespace {

using V = LaneVector;

inline V read(const std::array<AlignedVector<float>, 3>& array, std::size_t first) {
  return {Lane::load(&array[0][first]), Lane::load(&array[1][first]), Lane::load(&array[2][first])};
}
inline void write(std::array<AlignedVector<float>, 3>& array, std::size_t first, const V& value) {
  value.x.store(&array[0][first]);
  value.y.store(&array[1][first]);
  value.z.store(&array[2][first]);
}
// Displacements between the two places of each bond, and what the places have turned.
struct Ends {
  V between, Wi, Wj;
};
template <class Between>
HWY_INLINE Ends read_ends(const std::int32_t* i, const std::int32_t* j, const std::vector<SixVector>& moved,
                          Between between) {
  const auto turned = [&](const std::int32_t* place) __attribute__((always_inline)) {
    return from_quarters([&](std::size_t l) { return Quad::load(moved[place[l]].at + 4); });
  };
  return {from_quarters([&](std::size_t l) { return between(i[l], j[l]); }), turned(i), turned(j)};
}
// Factor that brings a spring of a given displacement back to its limit, 1 if within.
inline Lane cap(const Lane& squared, const Lane& limit) { return min(limit * inverse_sqrt(max(squared, 1e-36f)), 1); }

}  // namespace

// The force on j and the torques on both.
HWY_INLINE void BondBlock::write_loads(std::size_t b, const LaneVector& force, const LaneVector& on_i,
                                       const LaneVector& on_j) {
  const Quarters to_j = to_quarters(force), to_i = {-to_j[0], -to_j[1], -to_j[2], -to_j[3]};
  to_six_vectors(to_i, to_quarters(on_i), &loads_[2 * lanes + 2 * b]);
  to_six_vectors(to_j, to_quarters(on_j), &loads_[3 * lanes + 2 * b]);
}

// The bonds of one register, in one go from positions to loads: what is needed only in between stays in registers.
void BondBlock::move(std::size_t b, const MotionBlock& motion, Extremes& extremes) {
  const std::int32_t *i = &i_[b], *j = &j_[b];
  const auto constant = [&](Constant which) __attribute__((always_inline)) { return this->constant(which, b); };
  const auto [D, Wi, Wj] = read_ends(i, j, motion.moved, [&](std::int32_t from, std::int32_t to) {
    return difference(motion.position[to], motion.position[from]);
  });
  const V W = Wj - Wi;
  const Lane a_i = constant(radius_i), a_j = constant(radius_j), reach = constant(sum_of_radii);
  const Lane squared = dot(D, D), inverse = inverse_sqrt(squared), distance = squared * inverse;
  const Lane gap = (squared - reach * reach) / (distance + reach);
  const V n0 = read(normal_, b), n = inverse * D, sum = n0 + n, moved = D - read(apart_, b);
  // The normal turns little in a step: 1/|sum| and 1/(1 + n0 n) to second order in 1 - n0 n.
  const V turned = n - n0;
  const Lane bend = 0.5f * dot(turned, turned), half = 0.5f + bend * (0.25f + 0.125f * bend);
  const V mid = (0.5f + bend * (0.125f + 0.046875f * bend)) * sum;
  const Lane stretch = distance * constant(inverse_reach);
  const V arm = stretch * (a_i * Wi + a_j * Wj);
  const Lane twist = dot(mid, W);
  const V slide = moved - dot(mid, moved) * mid - cross(arm, mid), roll = W - twist * mid;
  // Carried along: the smallest rotation from n0 to n, then the mean spin about n (sine and cosine to third order).
  const Lane spin = 0.5f * dot(mid, Wi + Wj), s = spin * (1 - spin * spin * (1.0f / 6)), c = 1 - 0.5f * spin * spin;
  const auto carry = [&](const V& history, const V& increase) __attribute__((always_inline)) {
    const V v = history - (half * dot(n, history)) * sum, carried = c * v + s * cross(n, v) + increase;
    return carried - dot(n, carried) * n;
  };
  V sliding = carry(read(sliding_, b), slide), rolling = carry(read(rolling_, b), roll);
  sliding = cap(dot(sliding, sliding), constant(most_sliding)) * sliding;
  rolling = cap(dot(rolling, rolling), constant(most_rolling)) * rolling;
  const Lane most = constant(most_twisting), twisting = max(min(Lane::load(&twisting_[b]) + twist, most), -most);
  write(apart_, b, D);
  write(normal_, b, n);
  write(sliding_, b, sliding);
  write(rolling_, b, rolling);
  twisting.store(&twisting_[b]);
  gap.store(&gap_[b]);

  const Lane reached = Lane::load(&lost_gap_[b]);
  const Lane holds = where_greater(reached, gap, 1, 0);
  const Lane root = jkr_root(min(gap, reached) * constant(inverse_length)), cubed = root * root * root;
  const Lane tension = holds * (4 * constant(pull_off) * cubed * (1 - cubed));
  const V F = (-holds * constant(k_s)) * sliding;
  const V M = (-holds * constant(k_t) * twisting) * n - (holds * constant(k_r)) * rolling;
  const V turn = stretch * cross(n, F);
  write_loads(b, F - tension * n, -(M + a_i * turn), M - a_j * turn);
  holds.store(&holds_[b]);
  extremes.holding = min(extremes.holding, holds);
  // Lanes beyond the last bond may hold one that was removed.
  const Lane overlap = where_greater(static_cast<float>(count_ - b), Lane::iota(), -gap * constant(inverse_radius), 0);
  extremes.deepest = max(extremes.deepest, overlap);
}

// Room for the bonds of a while; by themselves arrays double.
void BondBlock::make_room_for_loads() {
  const std::size_t size = 2 * lanes + 2 * padded(count_);
  if (size > loads_.capacity()) loads_.reserve(size + size / 32);
  loads_.resize(size);
}

void BondBlock::forget_loads() {
  loads_ = {};
  links_ = {};
  for (auto* array : {&holds_, &slope_, &remembered_}) *array = {};
}

void BondBlock::advance(const MotionBlock& motion) {
  make_room_for_loads();
  Extremes all;
  if (count_ < many) {
    for (std::size_t b = 0; b < count_; b += lanes) move(b, motion, all);
  } else {
#pragma omp parallel
    {
      Extremes mine;
#pragma omp for schedule(static) nowait
      for (std::size_t b = 0; b < count_; b += lanes) move(b, motion, mine);
#pragma omp critical
      {
        all.holding = min(all.holding, mine.holding);
        all.deepest = max(all.deepest, mine.deepest);
      }
    }
  }
  deepest_ = std::max(deepest_, all.deepest.largest());
  lost_.clear();
  if (all.holding.least() > 0) return;
  for (std::size_t b = 0; b < count_; ++b)
    if (holds_[b] == 0) lost_.push_back(static_cast<std::int32_t>(b));
}

// dN/dh = 9 F_po/L c^2 (2 c^3 - 1)/(6 c^3 - 1), c of jkr_root.
Lane BondBlock::slope(std::size_t b) const {
  const Lane scale = constant(inverse_length, b),
             root = jkr_root(min(Lane::load(&gap_[b]), Lane::load(&lost_gap_[b])) * scale), cubed = root * root * root;
  return max(9 * constant(pull_off, b) * scale * root * root * (2 * cubed - 1) / (6 * cubed - 1), 0);
}

void BondBlock::find_stiffness(std::size_t from) {
  const std::size_t first = from / lanes * lanes;
#pragma omp parallel for schedule(static) if (count_ - first >= many)
  for (std::size_t b = first; b < count_; b += lanes) slope(b).store(&slope_[b]);
}

// The law of move() to first order in the ways.
void BondBlock::move_as_springs(std::size_t b, const std::vector<SixVector>& ways) {
  const std::int32_t *i = &i_[b], *j = &j_[b];
  const auto [U, Wi, Wj] = read_ends(i, j, ways, [&](std::int32_t from, std::int32_t to) {
    return Quad::load(ways[to].at) - Quad::load(ways[from].at);
  });
  const V n = read(normal_, b), W = Wj - Wi;
  const Lane a_i = constant(radius_i, b), a_j = constant(radius_j, b), apart = dot(n, U), twist = dot(n, W);
  const V F = (-constant(k_s, b)) * (U - apart * n - cross(a_i * Wi + a_j * Wj, n));
  const V M = (-constant(k_t, b) * twist) * n - constant(k_r, b) * (W - twist * n);
  const V turn = cross(n, F);
  write_loads(b, F - (Lane::load(&slope_[b]) * apart) * n, -(M + a_i * turn), M - a_j * turn);
}

void BondBlock::respond(const std::vector<SixVector>& ways) {
  make_room_for_loads();
#pragma omp parallel for schedule(static) if (count_ >= many)
  for (std::size_t b = 0; b < count_; b += lanes) move_as_springs(b, ways);
}

void BondBlock::remember_stiffness() { std::copy_n(slope_.begin(), count_, remembered_.begin()); }

BondBlock::Stiffness BondBlock::stiffening_on(std::size_t place) const {
  Stiffness sum;
  const std::int32_t* links = links_.data() + place * capacity_;
  for (std::int32_t k = 0; k < degree_[place]; ++k) {
    const auto end = static_cast<std::size_t>(links[k]);
    const std::size_t b = (end / (2 * lanes) - 1) * lanes + lane_at_place[end % lanes], c = uniform_ ? 0 : b;
    const bool fresh = remembered_[b] < 0;
    const float stiffer = slope_[b] - std::max(remembered_[b], 0.0f);
    if (!fresh && stiffer <= 0) continue;
    const Eigen::Vector3f n(normal_[0][b], normal_[1][b], normal_[2][b]);
    const Eigen::Matrix3f nn = n * n.transpose();
    sum.displacing += 2 * stiffer * nn;
    if (!fresh) continue;
    const Eigen::Matrix3f across = 3.5f * constants_[k_s][c] * (Eigen::Matrix3f::Identity() - nn);
    sum.across += across;
    sum.displacing += across;
    sum.turning += 2 * std::max(constants_[k_r][c], constants_[k_t][c]);
  }
  return sum;
}

}  // namespace crumble::dryer

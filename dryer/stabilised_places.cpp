// Who takes part in a step() of stabilised steps, and where in the blocks.
#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

#include "common/agglomerate/bond.hpp"
#include "dryer/drag.hpp"
#include "dryer/stabilised.hpp"

namespace crumble::dryer {

namespace {

std::uint64_t spread(std::uint64_t x) {
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffff;
  x = (x | x << 16) & 0x1f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  return (x | x << 2) & 0x1249249249249249;
}

// clear() would keep the memory.
template <class... Arrays>
void release(Arrays&... arrays) {
  ((arrays = Arrays()), ...);
}

// Neighbours in space get neighbouring places, so that what a bond reads is in the cache.
std::uint64_t morton(const Vector3& x, double width) {
  std::uint64_t key = 0;
  for (int k = 0; k < 3; ++k) key |= spread(static_cast<std::uint64_t>(std::max(0.0, x[k] / width + 1048576.0))) << k;
  return key;
}

}  // namespace

bool Stabilised::is_dry(std::int32_t p, double R) const {
  return dryer::is_dry(state_.particles.radius[p], state_.state.position[p].norm(), R);
}

// With noise: whom a bond or the surface may hold up until it is at R. Those near another come on top.
std::vector<char> Stabilised::who_moves(double R) const {
  const Frame& f = state_.state;
  std::vector<char> moves(place_.size(), 0);
  const double now = front_.radius(f.time), reach = 0.5 * near_ * smallest_radius();
  for (std::size_t p = 0; p < place_.size(); ++p) {
    const auto particle = static_cast<std::int32_t>(p);
    moves[p] = f.position[p].norm() + state_.particles.radius[p] + reach > R && !is_dry(particle, now);
  }
  for (const Contact& bond : f.contacts) moves[bond.i] = moves[bond.j] = 1;
  return moves;
}

// Who moves and who may be met: the list depends on the state alone.
void Stabilised::choose(double R_end) {
  Frame& f = state_.state;
  activity_.front_at(R_end);
  const double a = smallest_radius();
  std::vector<Pair> pairs;
  NeighbourSearch().find(f.position, state_.particles.radius, near_ * a, pairs);
  erase_bonded(pairs, f.contacts);
  const double R = front_.radius(f.time);
  const std::vector<char> moves = noise_ ? who_moves(R_end) : std::vector<char>();
  const auto rests = [&](std::int32_t p) {
    return noise_ ? !moves[p] && is_dry(p, R) && !model_.dry.everything_acts : !activity_.is_active(p);
  };
  std::erase_if(pairs, [&](const Pair& p) { return rests(p.i) && rests(p.j); });
  std::vector<std::pair<std::uint64_t, std::int32_t>> order;
  const auto choose_one = [&](std::int32_t p) {
    if (place_[p] >= 0) return;
    place_[p] = 0;
    order.emplace_back(morton(f.position[p], 2 * a), p);
  };
  std::fill(place_.begin(), place_.end(), -1);
  for (const std::int32_t p : activity_.active())
    if (!noise_ || moves[p]) choose_one(p);
  for (const Pair& pair : pairs) choose_one(pair.i), choose_one(pair.j);
  if (surface_forces_)
    for (const Pair& pair : surface_forces_->stiff_pairs()) choose_one(pair.i), choose_one(pair.j);
  std::sort(order.begin(), order.end());
  chosen_.clear();
  for (const auto& [key, p] : order) {
    place_[p] = static_cast<std::int32_t>(chosen_.size());
    chosen_.push_back(p);
  }
  for (const Pair& pair : pairs) open_pairs_.push_back({place_[pair.i], place_[pair.j]});
  for (std::size_t p = 0; noise_ && p < place_.size(); ++p)
    if (place_[p] < 0 && (model_.dry.everything_acts || !is_dry(static_cast<std::int32_t>(p), R))) free_.push_back(p);
  free_way_.assign(free_.size(), Vector3::Zero());
}

// Bonds are in the frame or in the block, not in both: each is a fourth of all memory.
void Stabilised::gather() {
  Frame& f = state_.state;
  const std::size_t count = chosen_.size();
  // In the order of their first place, for the cache.
  std::vector<std::pair<std::int32_t, std::int32_t>> order;
  order.reserve(f.contacts.size());
  for (std::size_t b = 0; b < f.contacts.size(); ++b)
    order.emplace_back(std::min(place_[f.contacts[b].i], place_[f.contacts[b].j]), static_cast<std::int32_t>(b));
  std::sort(order.begin(), order.end());
  bonds_.clear(count, f.contacts.size());
  known_rate_ = 0;
  for (const auto& [place, b] : order) {
    const Contact& bond = f.contacts[b];
    const BondLaw& law = laws_(bond.i, bond.j);
    bonds_.add(bond, place_[bond.i], place_[bond.j], law, state_.particles.radius[bond.i],
               state_.particles.radius[bond.j], law.lost_gap());
  }
  if (surface_forces_) surface_forces_->gather(place_, count, f.contacts);
  release(f.contacts);
  motion_.resize(count);
  mobility_.resize(count);
  radius_.assign(padded(count), 0);
  thermal_.assign(noise_ ? count : 0, {});
  noisy_.assign(count, 0);
  const double R = front_.radius(f.time);
  for (std::size_t m = 0; m < count; ++m) {
    const double a = state_.particles.radius[chosen_[m]];
    motion_.position[m] = position(f.position[chosen_[m]]);
    const bool dry = noise_ && is_dry(chosen_[m], R);
    const double drag = dry ? model_.dry.drag_factor : 1;
    mobility_.translation[m] = static_cast<float>(1 / (drag * drag_coefficient(model_.viscosity, a)));
    mobility_.rotation[m] = static_cast<float>(1 / (drag * rotational_drag_coefficient(model_.viscosity, a)));
    radius_[m] = static_cast<float>(a);
    noisy_[m] = noise_ && (!dry || model_.dry.everything_acts);
  }
}

void Stabilised::put_back(double begin) {
  Frame& f = state_.state;
  const double passed = f.time - begin;
  for (std::size_t m = 0; m < chosen_.size(); ++m) {
    const std::int32_t p = chosen_[m];
    const Vector3 x = vector(motion_.position[m]);
    if (!x.allFinite())
      throw std::domain_error(fmt::format("step {} at t = {:.6g} s: particle {} is not finite", f.step, f.time, p));
    f.velocity[p] = passed > 0 ? Vector3((x - f.position[p]) / passed) : Vector3(Vector3::Zero());
    f.position[p] = x;
  }
  for (std::size_t k = 0; k < free_.size(); ++k) f.position[free_[k]] += free_way_[k];
  release(motion_, before_, moves_, mobility_, open_pairs_, closest_, closer_, thermal_, noisy_, free_, free_way_);
  bonds_.forget_loads();
  bonds_.hand_back(chosen_, laws_, f.contacts);
  for (const Contact& bond : f.contacts) activity_.wake(bond.i), activity_.wake(bond.j);
  statistics_.largest_overlap = std::max(statistics_.largest_overlap, bonds_.deepest_overlap());
  release(bonds_);
}

}  // namespace crumble::dryer

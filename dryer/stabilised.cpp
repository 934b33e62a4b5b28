#include "dryer/stabilised.hpp"

#include <fmt/core.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/agglomerate/bond.hpp"
#include "dryer/displacement.hpp"
#include "dryer/drag.hpp"
#include "dryer/surface_pull.hpp"

namespace crumble::dryer {

namespace {

// Of the front within a step(), in the largest displacement of a stabilised step. Behind a crust, whose hindrance
// stands for a step(), no more than that.
constexpr double steps_in_one = 8, steps_behind_crust = 1;
// Within a stabilised step there is room for a bond more on every particle, and for bonds pressed to so much more.
constexpr double room = 0.05;
// Evaluations from one look at stiffness, displacements and pairs to the next.
constexpr int look = 64;

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

Stabilised::Stabilised(const DryingModel& model, Agglomerate& state, const StabilisedControl& control,
                       std::uint64_t seed)
    : Integrator(model, state, 0),
      control_(control),
      near_(control.near(model.thermal_energy > 0)),
      place_(state.particles.size(), -1) {
  if (model.contact.normal != NormalLaw::jkr) throw std::invalid_argument("stabilised steps know the JKR law only");
  if (model.thermal_energy > 0) noise_.emplace(model, state.particles.radius, seed, control.brownian_displacement);
  state.state.velocity.resize(state.particles.size(), Vector3::Zero());
}

// Until the front has gone so many of the smallest radius, s.
double Stabilised::time_of_travel(double radii) const {
  const double t = state_.state.time, R = front_.radius(t);
  return front_.time_at(std::max(R - radii * smallest_radius(), 0.0)) - t;
}

void Stabilised::step(double latest_time) {
  Frame& f = state_.state;
  const double begin = f.time;
  const double steps = front_.may_slow_down() ? steps_behind_crust : steps_in_one;
  double end = std::min(begin + time_of_travel(steps * control_.largest_displacement), latest_time);
  if (noise_) {
    noise_->advance_to(begin);
    // As many as the way allows to pairs that are far enough apart not to be listed.
    const double root = near_ / (6 * noise_->displacement());
    end = std::min(end, noise_->end(static_cast<std::uint64_t>(root * root)));
  }
  choose(front_.radius(end));
  gather();
  if (next_dt_ == 0) next_dt_ = end - begin;
  if (chosen_.empty()) {
    if (noise_) end = std::min(end, noise_->end());
    advance_free(end - begin);
    f.time = end;
    ++f.step;  // frames need numbers that grow
    ++statistics_.steps;
  }
  try {
    meet(open_pairs_, 0);
    while (f.time < end) {
      const double before = f.time;
      load_thermally();
      stabilised_step(noise_ ? std::min(end, noise_->end()) : end);
      advance_free(f.time - before);
      // Within the next more pairs may come near.
      if (farthest() + control_.largest_displacement > 0.5 * near_) break;
    }
    bonds_.advance(motion_);
    lose();
    put_back(begin);
  } catch (...) {  // the state may be saved
    if (f.contacts.empty()) bonds_.hand_back(chosen_, laws_, f.contacts);
    throw;
  }
  front_.follow(state_);
}

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

void Stabilised::load_thermally() {
  if (!noise_) return;
  noise_->advance_to(state_.state.time);
  for (std::size_t m = 0; m < chosen_.size(); ++m)
    if (noisy_[m]) thermal_[m] = noise_->load(static_cast<std::size_t>(chosen_[m]));
}

// Those that nothing holds up, in this interval of the noise.
void Stabilised::advance_free(double passed) {
  for (std::size_t k = 0; k < free_.size(); ++k) free_way_[k] += passed * noise_->velocity(free_[k]);
}

// How far noise moves a particle in so long a time, in the smallest radius: 5.2 standard deviations of a component.
double Stabilised::thermal_way(double time) const {
  return noise_ ? 3 * noise_->displacement() * time / noise_->interval() : 0;
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

double Stabilised::rate() const {
  double most = 0;
  const std::size_t count = chosen_.size();
#pragma omp parallel for schedule(static) reduction(max : most) if (count > many)
  for (std::size_t m = 0; m < count; ++m) most = std::max(most, rate_increase(bonds_, mobility_, radius_[m], m, most));
  return known_rate_ + most;
}

// Of one bond between the smallest particles: the largest of the terms of rate_increase().
double Stabilised::rate_of_a_bond() const {
  const double a = smallest_radius();
  const BondLaw law(model_.contact, model_.material, a, a);
  const double least = noise_ ? std::min(1.0, model_.dry.drag_factor) : 1;
  return std::max(2 * law.normal_stiffness(), 3.5 * law.k_s) / (least * drag_coefficient(model_.viscosity, a));
}

// What a step is made stable for, 1/s.
double Stabilised::limit_of_rate() {
  const double one = rate_of_a_bond(), R = front_.radius(state_.state.time);
  const double zeta = drag_coefficient(model_.viscosity, smallest_radius());
  double surface = 0;
  if (R > 0)
    surface = noise_ ? ThermalLoads::surface_rate(model_, smallest_radius(), noise_->interval(), R)
                     : surface_rate(model_.droplet, smallest_radius(), zeta, R);
  is_stable(known_rate_ + 0.5 * one);
  return std::max((1 + room) * rate() + one, 4 * surface);
}

// Looks closer if what has been added may be too much.
bool Stabilised::is_stable(double limit) {
  bonds_.find_stiffness();
  if (rate() < limit) return true;
  known_rate_ = relaxation_rate(bonds_, mobility_);
  bonds_.remember_stiffness();
  return known_rate_ < limit;
}

bool Stabilised::nearer(const Pair& places, float gap) const {
  const Quad D = difference(motion_.position[places.j], motion_.position[places.i]);
  const float reach = radius_[places.i] + radius_[places.j] + gap;
  return (D * D).sum() <= reach * reach;
}

// Sorts out of the open pairs those that can meet until the next look.
void Stabilised::part(double time) {
  open_pairs_.insert(open_pairs_.end(), closest_.begin(), closest_.end());
  closest_.clear();
  closer_.resize(open_pairs_.size());
  const auto gap = static_cast<float>((control_.largest_displacement + 2 * thermal_way(time)) * smallest_radius());
#pragma omp parallel for schedule(static) if (open_pairs_.size() > many)
  for (std::size_t q = 0; q < open_pairs_.size(); ++q) closer_[q] = nearer(open_pairs_[q], gap);
  std::size_t left = 0;
  for (std::size_t q = 0; q < open_pairs_.size(); ++q) {
    if (closer_[q])
      closest_.push_back(open_pairs_[q]);
    else
      open_pairs_[left++] = open_pairs_[q];
  }
  open_pairs_.resize(left);
}

void Stabilised::stabilised_step(double latest_time) {
  Frame& f = state_.state;
  const double limit = limit_of_rate(), left = latest_time - f.time;
  double dt = std::min({next_dt_, left, time_of_travel(control_.largest_displacement)});
  if (left < 1.5 * dt) dt = left;
  const int stages = Chebyshev::stages(dt, limit);
  const Chebyshev method(stages);
  before_ = motion_.position;
  // The last stages are the longest, 2/stages of the step.
  const double until_next_look = dt * std::min(1.0, 2.0 * look / stages);
  part(until_next_look);
  int done = 0;
  bool within_limit = true;
  while (done < stages && within_limit) {
    bonds_.advance(motion_);
    lose();
    push(method.stage[done], dt, front_.radius(f.time + method.stage[done].time * dt));
    ++done;
    const bool known = meet(closest_, limit);
    if (done == stages) break;
    if (done % look == 0) {
      part(until_next_look);
      // Farther, and others than those that are known may meet.
      within_limit = farthest() < 0.5 * near_;
    }
    if (!known || done % look == 0) within_limit = is_stable(limit) && within_limit;
  }
  const bool whole = done == stages;
  const double passed = whole ? dt : method.reached[done - 1] * dt;
  f.time = whole && dt == left ? latest_time : f.time + passed;
  open_pairs_.insert(open_pairs_.end(), closest_.begin(), closest_.end());
  closest_.clear();
  meet(open_pairs_, limit);
  statistics_.rejected += !whole;
  statistics_.steps += done;
  statistics_.particle_steps += done * static_cast<std::int64_t>(chosen_.size());
  f.step += done;
  measure([&](std::size_t m) { return before_[m]; });
  for (double& way : moves_) way = std::max(way - thermal_way(passed), 0.0);
  const double moved = largest_but_snaps(moves_) / control_.largest_displacement;
  const double factor = std::clamp(0.9 / std::max(moved * (passed > 0 ? dt / passed : 1), 1e-3), 0.5, 2.0);
  // What an interval of the noise has left over is no reason for short steps.
  next_dt_ = noise_ && factor > 1 ? std::max(next_dt_, factor * dt) : factor * dt;
}

void Stabilised::push(const Chebyshev::Stage& stage, double dt, double R) {
  const std::size_t count = chosen_.size();
  if (count < many) {
    for (std::size_t m = 0; m < count; m += lanes) push_some(m, stage, dt, R);
    return;
  }
#pragma omp parallel for schedule(static)
  for (std::size_t m = 0; m < count; m += lanes) push_some(m, stage, dt, R);
}

// The places of one register.
void Stabilised::push_some(std::size_t first, const Chebyshev::Stage& stage, double dt, double R) {
  const std::size_t count = std::min(lanes, chosen_.size() - first);
  Position* position = motion_.position.data() + first;
  SixVector* moved = motion_.moved.data() + first;
  float pull[lanes] = {};
  surface_pulls(model_.droplet.surface_tension, R, position, &radius_[first], count, pull);

  const auto memory = static_cast<float>(stage.memory), push = static_cast<float>(stage.push * dt);
  for (std::size_t l = 0; l < count; ++l) {
    const auto x = load(position[l]);
    Six loads = bonds_.load_on(first + l) + six(pull[l] * in_single(x), 0);
    if (noise_) loads += load(thermal_[first + l]);
    const Six way = memory * load(moved[l]) + push * mobility_.of(first + l) * loads;
    store(moved[l], way);
    store(position[l], x + in_double(translation(way)));
  }
}

void Stabilised::lose() {
  const auto& lost = bonds_.lost();
  for (auto b = lost.rbegin(); b != lost.rend(); ++b) {
    const auto bond = static_cast<std::size_t>(*b);
    const std::int32_t i = bonds_.first(bond), j = bonds_.second(bond);
    closest_.push_back({i, j});
    // What the bond has left of motion is the method's, not theirs: nothing would stop it.
    motion_.moved[i] = motion_.moved[j] = {};
    bonds_.remove(bond);
    ++statistics_.contacts_lost;
  }
}

// Bonds what touches among the pairs and takes it from them. False if that may have brought the rate over the limit.
bool Stabilised::meet(std::vector<Pair>& pairs, double limit) {
  std::vector<std::size_t> touching;
  if (pairs.size() < many) {
    for (std::size_t q = 0; q < pairs.size(); ++q)
      if (nearer(pairs[q], 0)) touching.push_back(q);
  } else {
#pragma omp parallel
    {
      std::vector<std::size_t> mine;
#pragma omp for schedule(static) nowait
      for (std::size_t q = 0; q < pairs.size(); ++q)
        if (nearer(pairs[q], 0)) mine.push_back(q);
#pragma omp critical
      touching.insert(touching.end(), mine.begin(), mine.end());
    }
    std::sort(touching.begin(), touching.end());
  }
  bool within_limit = true;
  for (auto q = touching.rbegin(); q != touching.rend(); ++q) {
    const auto [i, j] = pairs[*q];
    pairs[*q] = pairs.back();
    pairs.pop_back();
    const std::int32_t p = chosen_[i], other = chosen_[j];
    const double a_p = state_.particles.radius[p], a_q = state_.particles.radius[other];
    const BondLaw& law = laws_(p, other);
    const Vector3 D = vector(motion_.position[j]) - vector(motion_.position[i]);
    bonds_.add(make_bond(law, p, other, D, a_p, a_q, state_.state.step), i, j, law, a_p, a_q, law.lost_gap());
    bonds_.find_stiffness(bonds_.size() - 1);
    for (const std::int32_t place : {i, j})
      within_limit =
          within_limit &&
          known_rate_ + rate_increase(bonds_, mobility_, radius_[place], static_cast<std::size_t>(place)) < limit;
    ++statistics_.contacts_made;
  }
  return within_limit;
}

// Displacements of all places from where they were, in the smallest radius.
template <class From>
void Stabilised::measure(From from) {
  const std::size_t count = chosen_.size();
  moves_.resize(count);
#pragma omp parallel for schedule(static) if (count > many)
  for (std::size_t m = 0; m < count; ++m) {
    const Quad D = difference(motion_.position[m], from(m));
    moves_[m] = std::sqrt((D * D).sum()) / smallest_radius();
  }
}

// The largest displacement since the beginning of the step().
double Stabilised::farthest() {
  measure([&](std::size_t m) { return position(state_.state.position[chosen_[m]]); });
  double most = moves_.empty() ? 0 : *std::max_element(moves_.begin(), moves_.end());
  for (const Vector3& way : free_way_) most = std::max(most, way.norm() / smallest_radius());
  return most;
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

void Stabilised::fields(SavedFields& f) {
  Integrator::fields(f);
  f("next_step", next_dt_);
}

}  // namespace crumble::dryer

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
// Of the stiffness that stands over a step() for explicit Euler: SurfaceLoads.
constexpr double soft_share = 0.05;

// Of the noise, within a step() after the one in which it begins: as many as the way allows to pairs that are far
// enough apart not to be listed.
std::uint64_t intervals(const StabilisedControl& control) {
  const double root = control.near(true) / (6 * control.brownian_displacement);
  return static_cast<std::uint64_t>(root * root);
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
  if (model.surface_forces) {
    const double a = smallest_radius();
    surface_forces_.emplace(model, laws_, state.particles, soft_stiffness(model, a, control), near_ * a);
  }
  state.state.velocity.resize(state.particles.size(), Vector3::Zero());
}

std::optional<double> Stabilised::ionic_strength() const {
  return surface_forces_ ? std::optional(surface_forces_->ionic_strength()) : std::nullopt;
}

double Stabilised::soft_stiffness(const DryingModel& model, double a, const StabilisedControl& control) {
  if (model.thermal_energy == 0) return 0;
  const double longest =
      static_cast<double>(intervals(control) + 1) * ThermalLoads::interval(model, a, control.brownian_displacement);
  return soft_share * drag_coefficient(model.viscosity, a) / longest;
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
    end = std::min(end, noise_->end(intervals(control_)));
  }
  if (surface_forces_) {
    surface_forces_->begin(f, front_.radius(0.5 * (begin + end)));
    repulsion_rate_ =
        2 * surface_forces_->stiffness_of_repulsion(f) / drag_coefficient(model_.viscosity, smallest_radius());
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

void Stabilised::load_thermally() {
  if (!noise_) return;
  noise_->advance_to(state_.state.time);
  for (std::size_t m = 0; m < chosen_.size(); ++m)
    if (noisy_[m]) thermal_[m] = noise_->load(static_cast<std::size_t>(chosen_[m]));
}

// Those that nothing holds up, in this interval of the noise.
void Stabilised::advance_free(double passed) {
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const std::size_t p = free_[k];
    free_way_[k] += passed * noise_->velocity(p);
    if (!surface_forces_) continue;
    const Quad& force = surface_forces_->soft_force(p);
    free_way_[k] +=
        passed / drag_coefficient(model_.viscosity, state_.particles.radius[p]) * Vector3(force[0], force[1], force[2]);
  }
}

// How far noise moves a particle in so long a time, in the smallest radius: 5.2 standard deviations of a component.
double Stabilised::thermal_way(double time) const {
  return noise_ ? 3 * noise_->displacement() * time / noise_->interval() : 0;
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
  return std::max((1 + room) * rate() + one + repulsion_rate_, 4 * surface);
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
  if (surface_forces_) surface_forces_->evaluate(motion_.position);
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
    if (surface_forces_)
      loads += six(
          surface_forces_->force(first + l) + surface_forces_->soft_force(static_cast<std::size_t>(chosen_[first + l])),
          0);
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
    if (surface_forces_) surface_forces_->set_bonded({chosen_[i], chosen_[j]}, false);
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
    if (surface_forces_) surface_forces_->set_bonded({p, other}, true);
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

void Stabilised::fields(SavedFields& f) {
  Integrator::fields(f);
  f("next_step", next_dt_);
}

}  // namespace crumble::dryer

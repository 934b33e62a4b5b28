#include "dryer/brownian.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "common/agglomerate/bond.hpp"
#include "dryer/drag.hpp"
#include "dryer/pair_statistics.hpp"
#include "dryer/surface_pull.hpp"

namespace crumble::dryer {

namespace {

// Six standard deviations of the approach of two particles within `time`, m.
double approach(double diffusivity, double time) { return 6 * std::sqrt(4 * diffusivity * time); }

// Of the forces between surfaces of two particles of radius a, at the ionic strengths that the droplet may have, N/m.
double surface_stiffness(const DryingModel& model, double a) {
  if (!model.surface_forces) return 0;
  const std::vector<double> radius{a, a};
  const BondLaws bonds(model.contact, model.material, radius);
  SurfaceForceLaws laws(*model.surface_forces, bonds, radius);
  double stiffest = 0;
  const double from = model.surface_forces->electrolyte.ionic_strength, to = model.surface_forces->solubility;
  constexpr int steps = 8;
  for (int k = 0; k <= steps; ++k) {
    laws.set_ionic_strength(from * std::pow(to / from, static_cast<double>(k) / steps));
    stiffest = std::max(stiffest, laws.largest_stiffness());
  }
  return stiffest;
}

// Of the stiffness that a long step of explicit Euler is stable for, half of which soft pairs may have in sum.
constexpr double soft_share = 0.05;

double soft_stiffness(const DryingModel& model, double a, double long_step) {
  return soft_share * drag_coefficient(model.viscosity, a) / long_step;
}

SixVector same_for_all_directions(double translation, double rotation) {
  return six_vector((Vector6() << Vector3::Constant(translation), Vector3::Constant(rotation)).finished());
}

}  // namespace

double Brownian::short_step(const DryingModel& model, double a, double contact_step) {
  const BondLaw law(model.contact, model.material, a, a);
  // Dry particles may move more easily; their contacts must be resolved too.
  const double drag = std::min(1.0, model.dry.drag_factor) * drag_coefficient(model.viscosity, a);
  return contact_step * drag / std::max({law.normal_stiffness(), law.k_s, surface_stiffness(model, a)});
}

Brownian::Scales Brownian::scales(const DryingModel& model, const Agglomerate& state, const BrownianControl& control) {
  const double a = *std::min_element(state.particles.radius.begin(), state.particles.radius.end());
  const double dt = short_step(model, a, control.contact_step);
  const double D = model.thermal_energy / drag_coefficient(model.viscosity, a);
  return {a, dt, approach(D, std::ldexp(dt, control.depth))};
}

Brownian::Brownian(const DryingModel& model, Agglomerate& state, std::uint64_t seed, const BrownianControl& control)
    : Brownian(model, state, seed, control, scales(model, state, control)) {}

Brownian::Brownian(const DryingModel& model, Agglomerate& state, std::uint64_t seed, const BrownianControl& control,
                   const Scales& scales)
    : Integrator(model, state, 0.3 + 2 * scales.margin / scales.radius, scales.margin / scales.radius),
      control_(control),
      path_(seed),
      dt_(scales.short_step),
      margin_(scales.margin),
      substeps_(1 << control.depth),
      ahead_(state.particles.size(), Vector6::Zero()),
      place_(state.particles.size(), -1) {
  if (model.contact.normal != NormalLaw::jkr) throw std::invalid_argument("Brownian drying knows the JKR law only");
  for (const double a : state.particles.radius) {
    drag_.push_back(dt_ / drag_coefficient(model.viscosity, a));
    turning_drag_.push_back(dt_ / rotational_drag_coefficient(model.viscosity, a));
  }
  if (model.surface_forces)
    surface_forces_.emplace(model, laws_, state.particles, soft_stiffness(model, scales.radius, long_step()), margin_);
}

std::optional<double> Brownian::ionic_strength() const {
  return surface_forces_ ? std::optional(surface_forces_->ionic_strength()) : std::nullopt;
}

bool Brownian::is_dry(std::int32_t p) const {
  return dryer::is_dry(state_.particles.radius[p], state_.state.position[p].norm(), R_);
}

void Brownian::step(double latest_time) {
  Frame& f = state_.state;
  R_ = front_.radius(f.time + 0.5 * long_step());
  classify();
  advance_slow();
  if (!fast_.empty()) {
    gather();
    for (int s = 0; s < substeps_; ++s) fast_step(s);
    put_back();
  }
  ++statistics_.steps;
  ++f.step;
  f.time = std::min(f.time + long_step(), latest_time);
  statistics_.particle_steps += static_cast<std::int64_t>(fast_.size());
  front_.follow(state_);
  if (statistics_.steps % 1000 == 0) check_finite();
}

// Who may touch somebody within the long step.
void Brownian::classify() {
  Frame& f = state_.state;
  const auto& radius = state_.particles.radius;
  open_.update(f.position, radius, f.contacts);
  std::fill(place_.begin(), place_.end(), -1);
  std::vector<Pair> near;
  for (const Pair& pair : open_.pairs()) {
    const double reach = radius[pair.i] + radius[pair.j] + margin_;
    if ((f.position[pair.j] - f.position[pair.i]).squaredNorm() < reach * reach) near.push_back(pair);
  }
  near_.assign(place_.size(), 0);
  if (surface_forces_) {
    surface_forces_->begin(f, R_);
    for (const Pair& pair : surface_forces_->stiff_pairs()) near_[pair.i] = near_[pair.j] = 1;
  }
  for (const Pair& pair : near) near_[pair.i] = near_[pair.j] = 1;
  for (const Contact& bond : f.contacts) near_[bond.i] = near_[bond.j] = 1;
  // Those in the liquid come first: only they need noise.
  fast_.clear();
  const bool noisy_when_dry = model_.dry.everything_acts;
  for (const bool wet : {true, false}) {
    for (std::size_t p = 0; p < place_.size(); ++p)
      if (near_[p] && (noisy_when_dry || !is_dry(static_cast<std::int32_t>(p))) == wet) {
        place_[p] = static_cast<std::int32_t>(fast_.size());
        fast_.push_back(static_cast<std::uint32_t>(p));
      }
    if (wet) noisy_ = fast_.size();
  }
  open_places_.clear();
  for (const Pair& pair : near) open_places_.push_back({place_[pair.i], place_[pair.j]});
}

void Brownian::gather() {
  const Frame& f = state_.state;
  const auto& radius = state_.particles.radius;
  const std::size_t count = fast_.size(), stride = padded(noisy_);
  motion_.resize(count);
  block_.radius.resize(count);
  block_.radius_in_single.assign(padded(count), 0);
  block_.pull.assign(padded(count), 0);
  for (auto* array : {&block_.drag, &block_.noise, &block_.ahead}) array->resize(count);
  for (std::size_t m = 0; m < fast_.size(); ++m) {
    const auto p = static_cast<std::int32_t>(fast_[m]);
    const bool dry = is_dry(p);
    const double mobile = dry ? 1 / model_.dry.drag_factor : 1;
    const double kT = dry && !model_.dry.everything_acts ? 0 : model_.thermal_energy;
    const double drag = mobile * drag_[p], turning = mobile * turning_drag_[p];
    block_.drag[m] = same_for_all_directions(drag, turning);
    block_.noise[m] = same_for_all_directions(std::sqrt(0.5 * kT * drag), std::sqrt(0.5 * kT * turning));
    block_.radius[m] = radius[p];
    block_.radius_in_single[m] = static_cast<float>(radius[p]);
    motion_.position[m] = position(f.position[p]);
    block_.ahead[m] = six_vector(ahead_[p]);
  }
  bonds_.clear(fast_.size());
  for (const Contact& bond : f.contacts) add_bond(bond, place_[bond.i], place_[bond.j]);
  if (surface_forces_) surface_forces_->gather(place_, count, f.contacts);
  path_.fill({fast_.data(), noisy_}, static_cast<std::uint64_t>(statistics_.steps), control_.depth, stride, noise_);
}

// How far a bond is made before the surfaces touch and lost before its law lets go, m. Events of a diffusion that is
// looked at once a step are missed between the looks; the remedy is to displace the boundaries by a fraction of the
// step's standard deviation (Broadie, Glasserman & Kou 1997: 0.58 for a plain random walk). 0.30 is what gives a pair
// the bonded fraction of the exact law at the default step; see the manual for the test.
double Brownian::early(std::int32_t i, std::int32_t j) const {
  constexpr double fraction = 0.30;
  const double n_i = block_.noise[i].at[0], n_j = block_.noise[j].at[0];
  return fraction * 2 * std::sqrt(n_i * n_i + n_j * n_j);
}

void Brownian::add_bond(const Contact& bond, std::int32_t i, std::int32_t j) {
  const BondLaw& law = laws_(bond.i, bond.j);
  bonds_.add(bond, i, j, law, block_.radius[i], block_.radius[j], law.lost_gap() - early(i, j));
}

void Brownian::fast_step(int step) {
  predict(step);
  touch();
  bonds_.advance(motion_);
  push();
  const auto& lost = bonds_.lost();
  for (auto b = lost.rbegin(); b != lost.rend(); ++b) {
    const auto bond = static_cast<std::size_t>(*b);
    const std::int32_t i = bonds_.first(bond), j = bonds_.second(bond);
    open_places_.push_back({i, j});
    const Pair pair{static_cast<std::int32_t>(fast_[i]), static_cast<std::int32_t>(fast_[j])};
    open_.open(pair);
    if (surface_forces_) surface_forces_->set_bonded(pair, false);
    bonds_.remove(bond);
    ++statistics_.contacts_lost;
  }
}

// Moves to where the contacts live, half of this step's noise beyond y, and keeps the other half for later.
void Brownian::predict(int step) {
  const auto move = [&](std::size_t m, const Six& half) {
    const Six way = load(block_.ahead[m]) + half;
    store(motion_.position[m], load(motion_.position[m]) + in_double(translation(way)));
    store(motion_.moved[m], way);
    store(block_.ahead[m], half);
  };
  const std::size_t stride = padded(noisy_);
  const float* dW = noise_.data() + static_cast<std::size_t>(step) * 6 * stride;
  for (std::size_t first = 0; first < noisy_; first += lanes) {
    const auto component = [&](std::size_t k) { return Lane::load(dW + k * stride + first); };
    SixVector noise[lanes];
    to_six_vectors(to_quarters({component(0), component(1), component(2)}),
                   to_quarters({component(3), component(4), component(5)}), noise);
    for (std::size_t m = first; m < std::min(first + lanes, noisy_); ++m)
      move(m, load(block_.noise[m]) * load(noise[place_of_lane(m - first)]));
  }
  for (std::size_t m = noisy_; m < fast_.size(); ++m) move(m, 0);
}

// Adds the way that the loads push within the step.
void Brownian::push() {
  surface();
  if (surface_forces_) surface_forces_->evaluate(motion_.position);
  for (std::size_t m = 0; m < fast_.size(); ++m) {
    Six loads = bonds_.load_on(m) + six(block_.pull[m] * in_single(load(motion_.position[m])), 0);
    if (surface_forces_) loads += six(surface_forces_->force(m) + surface_forces_->soft_force(fast_[m]), 0);
    store(block_.ahead[m], load(block_.ahead[m]) + load(block_.drag[m]) * loads);
  }
}

void Brownian::surface() {
  surface_pulls(model_.droplet.surface_tension, R_, motion_.position.data(), block_.radius_in_single.data(),
                fast_.size(), block_.pull.data());
}

// Bonds what touches.
void Brownian::touch() {
  for (std::size_t q = 0; q < open_places_.size();) {
    const auto [i, j] = open_places_[q];
    const Vector3 D = vector(motion_.position[j]) - vector(motion_.position[i]);
    const double a_i = block_.radius[i], a_j = block_.radius[j], reach = a_i + a_j + early(i, j);
    if (D.squaredNorm() > reach * reach) {
      ++q;
      continue;
    }
    const Pair pair{static_cast<std::int32_t>(fast_[i]), static_cast<std::int32_t>(fast_[j])};
    add_bond(make_bond(laws_(pair.i, pair.j), pair.i, pair.j, D, a_i, a_j, state_.state.step), i, j);
    open_.close(pair);
    if (surface_forces_) surface_forces_->set_bonded(pair, true);
    open_places_.erase(open_places_.begin() + static_cast<std::ptrdiff_t>(q));
    ++statistics_.contacts_made;
  }
}

void Brownian::advance_slow() {
  Frame& f = state_.state;
  slow_.clear();
  for (std::size_t p = 0; p < place_.size(); ++p)
    if (place_[p] < 0) slow_.push_back(static_cast<std::uint32_t>(p));
  const std::size_t count = slow_.size();
  path_.whole(slow_, static_cast<std::uint64_t>(statistics_.steps), slow_noise_);
  for (std::size_t m = 0; m < count; ++m) {
    const std::size_t p = slow_[m];
    Vector3& x = f.position[p];
    const double a = state_.particles.radius[p];
    const bool dry = is_dry(static_cast<std::int32_t>(p));
    const double drag = substeps_ * drag_[p] / (dry ? model_.dry.drag_factor : 1);
    const double kT = dry && !model_.dry.everything_acts ? 0 : model_.thermal_energy;
    x += ahead_[p].head<3>();
    ahead_[p].setZero();
    const Vector3 dW =
        std::sqrt(2 * kT * drag) * Vector3(slow_noise_[m], slow_noise_[count + m], slow_noise_[2 * count + m]);
    const Vector3 half = x + 0.5 * dW;
    const double r = half.norm();
    x += dW;
    if (surface_cuts(a, r, R_)) x -= drag * capillary_force(model_.droplet.surface_tension, a, r - R_) / r * half;
    if (surface_forces_) {
      const Quad& force = surface_forces_->soft_force(p);
      x += drag * Vector3(force[0], force[1], force[2]);
    }
  }
}

void Brownian::put_back() {
  Frame& f = state_.state;
  for (std::size_t m = 0; m < fast_.size(); ++m) {
    const std::uint32_t p = fast_[m];
    f.position[p] = vector(motion_.position[m]);
    ahead_[p] = vector(block_.ahead[m]);
  }
  bonds_.hand_back(fast_, laws_, f.contacts);
  statistics_.largest_overlap = std::max(statistics_.largest_overlap, bonds_.deepest_overlap());
}

void Brownian::check_finite() const {
  for (std::size_t p = 0; p < place_.size(); ++p)
    if (!state_.state.position[p].allFinite())
      throw std::domain_error(
          fmt::format("step {} at t = {:.6g} s: particle {} is not finite; integrator.contact_step = {:g} is too large",
                      state_.state.step, state_.state.time, p, control_.contact_step));
}

void Brownian::fields(SavedFields& f) {
  Integrator::fields(f);
  f("ahead", ahead_);
}

namespace {

// Share of the lifetime until the solids take up this share of the droplet.
double drying_until(double solids, double packing) {
  return std::clamp(1 - std::pow(solids / packing, 2.0 / 3), 0.0, 1.0);
}

// Share of the droplet that the solids take up when there are so many bonds a particle: 0.115 at 0.3, 0.26 at one; 1
// when the first is left dry, measured.
double packing_with(double bonds) { return std::min(0.115 + (bonds - 0.3) * (0.26 - 0.115) / (1 - 0.3), 1.0); }

}  // namespace

Work Brownian::expected_work(const DryingModel& model, const std::vector<double>& radius,
                             const std::vector<BrownianStage>& parts, double contact_step, const StepTimes& times) {
  const double a = radius.back(), N = static_cast<double>(radius.size()), phi = solids_share(model.droplet, radius);
  const double kT = model.thermal_energy, D = kT / drag_coefficient(model.viscosity, a);
  const double tau = model.droplet.lifetime, peclet = model.droplet.peclet(D);
  Work work;
  struct Stage {
    double end, step, margin, soft, stickiness, lifetime;
    int depth;
  };
  std::vector<Stage> stages;
  double begin = 0;
  for (const BrownianStage& part : parts) {
    const double step = short_step(part.model, a, contact_step);
    const double end = &part == &parts.back()        ? 1
                       : std::isinf(part.most_bonds) ? drying_until(phi, 1)
                                                     : drying_until(phi, packing_with(part.most_bonds));
    const PairStatistics pair = pair_statistics(Jkr(part.model.material, a), kT, 2 * D);
    const double long_step = std::ldexp(step, part.depth);
    stages.push_back({std::max(begin, end), step, approach(D, long_step), soft_stiffness(model, a, long_step),
                      pair.stickiness, pair.lifetime, part.depth});
    work.steps += std::max(end - begin, 0.0) * tau / long_step;
    begin = std::max(begin, end);
  }
  work.seconds = N * work.add_up([&](double fraction) {
    const double R = 1 - fraction, t = 1 - R * R;
    const auto stage = std::find_if(stages.begin(), stages.end() - 1, [&](const Stage& k) { return t <= k.end; });
    const double packing = std::min(phi / (R * R * R), 0.64);
    const double R0 = model.droplet.initial_radius;
    const double stiff = stiff_gap(model, a, stage->soft, phi * R0 * R0 * R0, R * R0);
    double share = share_near(packing, a, stage->margin + stiff, stage->stickiness);
    if (stage->lifetime > 0.1 * a * a / D) share = std::max(share, share_clustered(model, N, t * tau));
    const double swept = (1 - R * R * R) * peclet / (peclet + 20);
    share = swept + (1 - swept) * share;
    const double steps = 2 * R * tau / stage->step;  // short ones, for the front's way
    return steps * (share * times.packed + (1 - share) * std::ldexp(times.loose, -stage->depth));
  });
  return work;
}

}  // namespace crumble::dryer

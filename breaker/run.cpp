#include "breaker/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "breaker/explicit_euler.hpp"
#include "breaker/implicit.hpp"
#include "common/agglomerate/fragments.hpp"
#include "common/agglomerate/morphology.hpp"
#include "common/io/errors.hpp"

namespace crumble {

namespace {

std::vector<std::int32_t> all(std::size_t n) {
  std::vector<std::int32_t> numbers(n);
  for (std::size_t p = 0; p < n; ++p) numbers[p] = static_cast<std::int32_t>(p);
  return numbers;
}

void add(IntegratorStatistics& sum, const IntegratorStatistics& s) {
  sum.steps += s.steps;
  sum.rejected += s.rejected;
  sum.newton_iterations += s.newton_iterations;
  sum.factorisations += s.factorisations;
  sum.rigid_steps += s.rigid_steps;
  sum.largest_overlap = std::max(sum.largest_overlap, s.largest_overlap);
}

std::vector<double> radii_of(const Particles& particles, const std::vector<std::int32_t>& member) {
  std::vector<double> radius;
  for (const std::int32_t p : member) radius.push_back(particles.radius[p]);
  return radius;
}

}  // namespace

BreakupRun::BreakupRun(const BreakerScene& scene, const Agglomerate& start, double coarsening)
    : scene_(scene),
      particles_(start.particles),
      protocol_(scene.protocol),
      coarsening_(coarsening),
      whole_(start.state),
      severed_at_(start.particles.size(), -1) {
  broken_when_lost_ =
      scene.lost_particles ? static_cast<std::size_t>(*scene.lost_particles) : (particles_.size() + 19) / 20;
  Piece piece;
  piece.member = all(particles_.size());
  piece.integrator = integrate(piece, start.state);
  pieces_.push_back(std::move(piece));
  breakup_.contacts_initial = static_cast<std::int64_t>(pieces_.front().integrator->frame().contacts.size());
  note_fragments(pieces_.front());
  observe();
  breakup_.initial = breakup_.before = look_;
  breakup_.fragments = fragment_sizes(fragments(particles_.size(), pieces_.front().integrator->frame().contacts));
}

std::unique_ptr<Integrator> BreakupRun::integrate(const Piece& piece, Frame frame) const {
  const std::vector<double> radius = radii_of(particles_, piece.member);
  if (scene_.is_explicit) {
    try {
      return std::make_unique<ExplicitEuler>(scene_.model, protocol_, radius, std::move(frame), scene_.step,
                                             scene_.allow_unstable, coarsening_);
    } catch (const std::invalid_argument& error) {
      throw InputError(std::string("integrator.step: ") + error.what());
    }
  }
  return std::make_unique<Implicit>(scene_.model, protocol_, radius, std::move(frame), tolerance());
}

std::string BreakupRun::ending() const {
  if (broken_ || !finished_) return "";
  if (stress() < scene_.largest_stress) return "nothing broke until the end of the protocol";
  return fmt::format("nothing broke up to protocol.largest_stress = {:g} Pa", scene_.largest_stress);
}

double BreakupRun::time() const { return pieces_.empty() ? whole_.time : pieces_[turn_].integrator->frame().time; }
double BreakupRun::stress() const { return protocol_.stress_before(time()); }

double BreakupRun::fraction() const {
  if (broken_) return 1;
  return std::clamp(max_use_, 0.0, 0.99);
}

IntegratorStatistics BreakupRun::statistics() const {
  IntegratorStatistics sum = retired_;
  for (const Piece& piece : pieces_) add(sum, piece.integrator->statistics());
  return sum;
}

bool BreakupRun::can_be_saved() const {
  if (!scene_.is_explicit || pieces_.empty()) return true;
  return pieces_.front().integrator->statistics().steps % ExplicitEuler::restart_interval == 0;
}

// Rows of a frame, with the contacts among them, renumbered.
Frame BreakupRun::part_of(const Frame& frame, const std::vector<std::int32_t>& rows) const {
  Frame part;
  part.step = frame.step;
  part.time = frame.time;
  std::vector<std::int32_t> number(frame.position.size(), -1);
  for (const std::int32_t row : rows) {
    number[row] = static_cast<std::int32_t>(part.position.size());
    part.position.push_back(frame.position[row]);
    part.orientation.push_back(frame.orientation[row]);
  }
  for (Contact c : frame.contacts)
    if (number[c.i] >= 0 && number[c.j] >= 0) {
      c.i = number[c.i];
      c.j = number[c.j];
      part.contacts.push_back(c);
    }
  return part;
}

// The piece's particles and contacts into the whole, in the axes of the laboratory.
void BreakupRun::put_back(const Piece& piece) {
  const Frame lab = piece.integrator->laboratory();
  std::vector<bool> mine(particles_.size(), false);
  for (std::size_t row = 0; row < piece.member.size(); ++row) {
    mine[piece.member[row]] = true;
    whole_.position[piece.member[row]] = lab.position[row];
    whole_.orientation[piece.member[row]] = lab.orientation[row];
  }
  std::erase_if(whole_.contacts, [&](const Contact& c) { return mine[c.i]; });
  for (Contact c : lab.contacts) {
    c.i = piece.member[c.i];
    c.j = piece.member[c.j];
    whole_.contacts.push_back(c);
  }
  std::sort(whole_.contacts.begin(), whole_.contacts.end(),
            [](const Contact& a, const Contact& b) { return std::pair(a.i, a.j) < std::pair(b.i, b.j); });
  whole_.time = lab.time;
}

Frame BreakupRun::laboratory() const {
  BreakupRun& self = const_cast<BreakupRun&>(*this);  // whole_ is a cache of what the pieces know
  for (const Piece& piece : pieces_) self.put_back(piece);
  Frame frame = whole_;
  frame.step = statistics().steps;
  frame.time = time();
  return frame;
}

void BreakupRun::collect_events(const Piece& piece) {
  for (Event& e : pieces_[turn_].integrator->network().take_events()) {
    e.i = piece.member[e.i];
    e.j = piece.member[e.j];
    if (e.kind == EventKind::rupture && !breakup_.first_rupture) breakup_.first_rupture = e.stress;
    if (e.kind <= EventKind::roll && !breakup_.first_limit) breakup_.first_limit = e.stress;
    events_.push_back(std::move(e));
  }
}

// Who is in the largest fragment of the piece, and at which stress others left it.
void BreakupRun::note_fragments(const Piece& piece) {
  const auto label = fragments(piece.member.size(), piece.integrator->frame().contacts);
  const double now = protocol_.stress_before(piece.integrator->frame().time);
  for (std::size_t row = 0; row < label.size(); ++row) {
    double& severed = severed_at_[piece.member[row]];
    if (label[row] == 0)
      severed = -1;
    else if (severed < 0)
      severed = now;
  }
}

void BreakupRun::observe() {
  const Piece& piece = pieces_[turn_];
  const Frame& frame = piece.integrator->frame();
  look_.stress = protocol_.stress_before(frame.time);
  const std::vector<double> radius = radii_of(particles_, piece.member);
  std::vector<double> mass;
  for (const std::int32_t p : piece.member) mass.push_back(particles_.mass[p]);
  look_.radius_of_gyration = radius_of_gyration(frame.position, mass);
  look_.semi_axes = semi_axes(frame.position, radius, mass);
  look_.contacts = static_cast<std::int64_t>(frame.contacts.size());
  look_.largest_fragment = fragment_sizes(fragments(piece.member.size(), frame.contacts)).front();
  look_.network = network_state(frame.contacts, piece.integrator->network().laws());
  max_use_ = std::max(max_use_, look_.network.max_use);
  if (!broken_ && (past_.empty() || look_.stress > 1.001 * past_.back().stress)) past_.push_back(look_);
}

// What it looked like shortly before: once the last avalanche has begun shape says nothing about the way to it.
void BreakupRun::look_back(double stress) {
  for (const Look& look : past_)
    if (look.stress <= 0.99 * stress) breakup_.before = look;
}

namespace {

// Least gap between the two groups, m.
double distance(const Frame& frame, const std::vector<double>& radius, const std::vector<std::int32_t>& label,
                std::int32_t fragment) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < label.size(); ++p) {
    if (label[p] != fragment) continue;
    for (std::size_t q = 0; q < label.size(); ++q)
      if (label[q] != fragment)
        least = std::min(least, (frame.position[p] - frame.position[q]).norm() - radius[p] - radius[q]);
  }
  return least;
}

}  // namespace

// Takes fragments that are beyond reach out of the piece; each goes on alone.
void BreakupRun::divide(std::size_t number) {
  const Frame& frame = pieces_[number].integrator->frame();
  const std::vector<std::int32_t> member = pieces_[number].member;
  const std::vector<double> radius = radii_of(particles_, member);
  const auto label = fragments(member.size(), frame.contacts);
  const auto sizes = fragment_sizes(label);
  if (sizes.size() < 2) return;
  const double reach = scene_.reach * mean_radius(particles_);
  std::vector<std::int32_t> lost;
  for (std::int32_t f = 1; f < static_cast<std::int32_t>(sizes.size()); ++f)
    if (distance(frame, radius, label, f) > reach) lost.push_back(f);
  if (lost.empty()) return;

  put_back(pieces_[number]);
  add(retired_, pieces_[number].integrator->statistics());
  const Frame lab = pieces_[number].integrator->laboratory();
  const double now = frame.time, stress = protocol_.stress_before(now);
  std::vector<Piece> parts(1 + lost.size());
  std::vector<std::vector<std::int32_t>> rows(parts.size());
  for (std::size_t row = 0; row < label.size(); ++row) {
    const auto place = std::find(lost.begin(), lost.end(), label[row]);
    const std::size_t part = place == lost.end() ? 0 : 1 + static_cast<std::size_t>(place - lost.begin());
    rows[part].push_back(static_cast<std::int32_t>(row));
    parts[part].member.push_back(member[row]);
  }
  for (std::size_t part = 0; part < parts.size(); ++part) {
    parts[part].integrator = integrate(parts[part], part_of(lab, rows[part]));
    parts[part].last_rupture = now;
  }
  pieces_[number] = std::move(parts.front());
  const bool breaks = !broken_ && particles_.size() - pieces_[number].member.size() >= broken_when_lost_;
  // Before breakup small fragments stay where they were lost; afterwards whatever can break goes on.
  for (std::size_t part = 1; part < parts.size(); ++part)
    if ((broken_ || breaks) && parts[part].member.size() > 1) pieces_.push_back(std::move(parts[part]));
  const auto all_sizes = fragment_sizes(fragments(particles_.size(), whole_.contacts));
  events_.push_back({now, stress, EventKind::fragment_lost, -1, -1, all_sizes});
  breakup_.fragments = all_sizes;
  if (breaks) end_with_breakup();
}

// The stress at which as many particles as make a breakup had left what still holds together.
double BreakupRun::critical_stress() const {
  std::vector<bool> lost(particles_.size(), true);
  for (const std::int32_t p : pieces_.front().member) lost[p] = false;
  std::vector<double> severed;
  for (std::size_t p = 0; p < lost.size(); ++p)
    if (lost[p]) severed.push_back(severed_at_[p]);
  const auto decisive = severed.begin() + static_cast<std::ptrdiff_t>(broken_when_lost_ - 1);
  std::nth_element(severed.begin(), decisive, severed.end());
  return *decisive;
}

void BreakupRun::end_with_breakup() {
  broken_ = true;
  breakup_.severed = critical_stress();
  look_back(*breakup_.severed);
  breakup_.lost = stress();
  if (!scene_.until_stable) {
    finished_ = true;
    return;
  }
  settle();
}

// From now on the stress is held. Window after window of a strain of one all pieces move, one after the other.
void BreakupRun::settle() {
  const double now = time(), stress = protocol_.stress_before(now);
  std::vector<Stage> stages;
  double begin = 0;
  for (const Stage& stage : protocol_.stages()) {
    if (begin >= now) break;
    stages.push_back(stage);
    stages.back().duration = std::min(stage.duration, now - begin);
    begin += stage.duration;
  }
  stages.push_back({stress, 0, std::numeric_limits<double>::infinity()});
  protocol_ = Protocol(std::move(stages));
  window_end_ = now;
  next_turn();
}

void BreakupRun::next_turn() {
  if (!broken_) return;
  for (std::size_t k = 0; k < pieces_.size(); ++k)
    if (pieces_[k].integrator->frame().time < window_end_) {
      turn_ = k;
      return;
    }
  const double strain = scene_.model.viscosity / protocol_.stress_before(window_end_);
  bool stable = true;
  for (const Piece& piece : pieces_)
    stable = stable && window_end_ - piece.last_rupture >= scene_.stable_strain * strain;
  turn_ = 0;
  if (stable)
    finished_ = true;
  else
    window_end_ += strain;
}

void BreakupRun::step() {
  if (finished_) return;
  Piece& piece = pieces_[turn_];
  const double now = piece.integrator->frame().time;
  const double latest = broken_ ? window_end_ : protocol_.stage_end(now);
  const bool changed = piece.integrator->step(latest);
  at_stage_end_ = !broken_ && piece.integrator->frame().time == latest;
  observe();
  const std::size_t told = events_.size();
  collect_events(piece);
  if (std::any_of(events_.begin() + static_cast<std::ptrdiff_t>(told), events_.end(),
                  [](const Event& e) { return e.kind == EventKind::rupture; }))
    piece.last_rupture = piece.integrator->frame().time;
  if (changed) {
    note_fragments(piece);
    breakup_.fragments = fragment_sizes(fragments(particles_.size(), laboratory().contacts));
  }
  if (look_.largest_fragment < static_cast<std::int64_t>(piece.member.size())) divide(turn_);
  if (finished_) return;
  if (broken_) {
    next_turn();
    return;
  }
  if (stress() >= scene_.largest_stress) {
    finished_ = true;
    look_back(2 * stress());
  } else if (time() >= protocol_.end()) {
    finished_ = true;
    look_back(2 * stress());
  }
}

BreakupRun::Memory BreakupRun::memory() const {
  Memory m;
  m.whole = laboratory();
  const auto put_look = [&](const Look& l) {
    m.numbers.insert(m.numbers.end(), {l.stress, l.radius_of_gyration, l.semi_axes[0], l.semi_axes[1], l.semi_axes[2],
                                       l.network.max_tension, l.network.max_use});
    m.counts.insert(m.counts.end(),
                    {l.contacts, l.largest_fragment, l.network.slipping, l.network.twisting, l.network.rolling});
  };
  put_look(look_);
  put_look(breakup_.initial);
  put_look(breakup_.before);
  m.counts.push_back(static_cast<std::int64_t>(past_.size()));
  for (const Look& look : past_) put_look(look);
  for (const auto& stress : {breakup_.first_limit, breakup_.first_rupture, breakup_.severed, breakup_.lost})
    m.numbers.push_back(stress.value_or(-1));
  m.numbers.insert(m.numbers.end(), {window_end_, max_use_, retired_.largest_overlap});
  m.counts.insert(m.counts.end(),
                  {breakup_.contacts_initial, static_cast<std::int64_t>(turn_), broken_, finished_, retired_.steps,
                   retired_.rejected, retired_.newton_iterations, retired_.factorisations, retired_.rigid_steps});
  m.numbers.insert(m.numbers.end(), severed_at_.begin(), severed_at_.end());
  m.counts.push_back(static_cast<std::int64_t>(events_.size()));
  for (const Event& e : events_) {
    m.numbers.insert(m.numbers.end(), {e.time, e.stress});
    m.counts.insert(m.counts.end(),
                    {static_cast<std::int64_t>(e.kind), e.i, e.j, static_cast<std::int64_t>(e.sizes.size())});
    m.counts.insert(m.counts.end(), e.sizes.begin(), e.sizes.end());
  }
  m.counts.push_back(static_cast<std::int64_t>(protocol_.stages().size()));
  for (const Stage& stage : protocol_.stages())
    m.numbers.insert(m.numbers.end(), {stage.stress, stage.rate, stage.duration});
  for (const Piece& piece : pieces_) {
    m.numbers.push_back(piece.last_rupture);
    m.frames.push_back(piece.integrator->frame());
    m.members.emplace_back(piece.member.begin(), piece.member.end());
    m.told.push_back(piece.integrator->network().limits_told());
    m.integrators.push_back(piece.integrator->memory());
  }
  return m;
}

void BreakupRun::recall(const Memory& m) {
  auto number = m.numbers.begin();
  auto count = m.counts.begin();
  const auto take_look = [&](Look& l) {
    l.stress = *number++;
    l.radius_of_gyration = *number++;
    for (double& axis : l.semi_axes) axis = *number++;
    l.network.max_tension = *number++;
    l.network.max_use = *number++;
    l.contacts = *count++;
    l.largest_fragment = *count++;
    l.network.slipping = *count++;
    l.network.twisting = *count++;
    l.network.rolling = *count++;
  };
  take_look(look_);
  take_look(breakup_.initial);
  take_look(breakup_.before);
  past_.resize(static_cast<std::size_t>(*count++));
  for (Look& look : past_) take_look(look);
  for (auto* stress : {&breakup_.first_limit, &breakup_.first_rupture, &breakup_.severed, &breakup_.lost}) {
    *stress = *number < 0 ? std::nullopt : std::optional(*number);
    ++number;
  }
  window_end_ = *number++;
  max_use_ = *number++;
  retired_.largest_overlap = *number++;
  breakup_.contacts_initial = *count++;
  turn_ = static_cast<std::size_t>(*count++);
  broken_ = *count++ != 0;
  finished_ = *count++ != 0;
  for (auto* s : {&retired_.steps, &retired_.rejected, &retired_.newton_iterations, &retired_.factorisations,
                  &retired_.rigid_steps})
    *s = *count++;
  for (double& s : severed_at_) s = *number++;
  events_.resize(static_cast<std::size_t>(*count++));
  for (Event& e : events_) {
    e.time = *number++;
    e.stress = *number++;
    e.kind = static_cast<EventKind>(*count++);
    e.i = static_cast<std::int32_t>(*count++);
    e.j = static_cast<std::int32_t>(*count++);
    e.sizes.resize(static_cast<std::size_t>(*count++));
    for (std::int64_t& size : e.sizes) size = *count++;
  }
  std::vector<Stage> stages(static_cast<std::size_t>(*count++));
  for (Stage& stage : stages) {
    stage.stress = *number++;
    stage.rate = *number++;
    stage.duration = *number++;
  }
  protocol_ = Protocol(std::move(stages));
  whole_ = m.whole;
  breakup_.fragments = fragment_sizes(fragments(particles_.size(), whole_.contacts));
  pieces_.clear();
  for (std::size_t k = 0; k < m.frames.size(); ++k) {
    Piece piece;
    piece.member.assign(m.members[k].begin(), m.members[k].end());
    piece.last_rupture = *number++;
    piece.integrator = integrate(piece, m.frames[k]);
    piece.integrator->network().recall_limits(m.told[k]);
    piece.integrator->recall(m.integrators[k]);
    pieces_.push_back(std::move(piece));
  }
}

}  // namespace crumble

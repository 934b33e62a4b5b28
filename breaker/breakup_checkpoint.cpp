#include "breaker/breakup_checkpoint.hpp"

#include "common/io/frame_checkpoint.hpp"

namespace crumble {

namespace {

std::string piece_name(const char* what, std::size_t k) { return what + std::string("_") + std::to_string(k); }

}  // namespace

void BreakupCheckpoint::save(const BreakupRun& run, const Progression& progression) const {
  const BreakupRun::Memory m = run.memory();
  Checkpoint out;
  out.reals["run"] = m.numbers;
  out.integers["run_counts"] = m.counts;
  out.integers["pieces"] = {static_cast<std::int64_t>(m.frames.size())};
  store_frame(m.whole, "whole", out);
  for (std::size_t k = 0; k < m.frames.size(); ++k) {
    store_frame(m.frames[k], piece_name("piece", k), out);
    out.integers[piece_name("member", k)] = m.members[k];
    out.integers[piece_name("told", k)] = m.told[k];
    out.reals[piece_name("integrator", k)] = m.integrators[k].numbers;
    out.integers[piece_name("integrator_counts", k)] = m.integrators[k].counts;
  }
  out.reals["progression"] = {progression.next_sample, progression.next_frame};
  out.integers["last_step"] = {progression.last_step};
  out.integers["halvings"] = {progression.halvings};
  if (progression.companion) out.reals["companion"] = {*progression.companion};
  store(out);
}

Progression BreakupCheckpoint::progression() const {
  Progression p;
  p.next_sample = stored().real("progression").at(0);
  p.next_frame = stored().real("progression").at(1);
  p.last_step = stored().integer("last_step").at(0);
  p.halvings = stored().integer("halvings").at(0);
  if (stored().reals.contains("companion")) p.companion = stored().real("companion").at(0);
  return p;
}

void BreakupCheckpoint::resume(BreakupRun& run) const {
  BreakupRun::Memory m;
  m.numbers = stored().real("run");
  m.counts = stored().integer("run_counts");
  m.whole = restore_frame(stored(), "whole");
  const auto pieces = static_cast<std::size_t>(stored().integer("pieces").at(0));
  for (std::size_t k = 0; k < pieces; ++k) {
    m.frames.push_back(restore_frame(stored(), piece_name("piece", k)));
    m.members.push_back(stored().integer(piece_name("member", k)));
    m.told.push_back(stored().integer(piece_name("told", k)));
    m.integrators.push_back(
        {stored().real(piece_name("integrator", k)), stored().integer(piece_name("integrator_counts", k))});
  }
  run.recall(m);
}

}  // namespace crumble

#include "common/io/state_keeper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "common/io/file_errors.hpp"

namespace crumble {
namespace {

using Seconds = std::chrono::duration<double>;

constexpr double rarest = 200;         // a copy is made at most once in so many times what it takes
constexpr double shortest = 0.05;      // s, from one copy in memory to the next
constexpr std::size_t most = 8 << 20;  // numbers of the state that is copied in memory

std::size_t numbers(const SavedState& state) {
  std::size_t count = 0;
  for (const auto& [name, values] : state.reals) count += values.size();
  for (const auto& [name, values] : state.integers) count += values.size();
  return count;
}

}  // namespace

StateKeeper::StateKeeper(const OutputCheckpoint& checkpoint, double interval, std::function<void(SavedFields&)> fields,
                         FrameLog* frames, Say say)
    : checkpoint_(checkpoint),
      interval_(interval),
      fields_(std::move(fields)),
      frames_(frames),
      say_(std::move(say)),
      on_disk_(checkpoint.found()),
      disk_due_(Clock::now() + std::chrono::duration_cast<Clock::duration>(Seconds(std::min(interval, 1e9)))),
      memory_due_(Clock::now()),
      at_sudden_end_([this] { return save_the_remembered(); }) {}

SavedState StateKeeper::collect() {
  return checkpoint_.collect([this](SavedFields& f) {
    if (frames_) {
      FrameLog::Mark mark = frames_->mark();
      mark.fields(f.in("frames"));
    }
    fields_(f);
  });
}

// First the frames, then the state that says how many there are.
void StateKeeper::write(const SavedState& state) {
  if (frames_) frames_->flush();
  checkpoint_.write(state);
  if (frames_) frames_->keep();
  on_disk_ = true;
}

void StateKeeper::save() {
  const auto begin = Clock::now();
  const SavedState state = collect();
  const std::lock_guard lock(writing_);
  write(state);
  remembered_.reset();
  const auto end = Clock::now();
  const Seconds pause(std::max(std::min(interval_, 1e9), rarest * Seconds(end - begin).count()));
  disk_due_ = end + std::chrono::duration_cast<Clock::duration>(pause);
}

void StateKeeper::remember() {
  const auto begin = Clock::now();
  auto state = std::make_shared<const SavedState>(collect());
  small_ = numbers(*state) <= most;
  const auto end = Clock::now();
  const Seconds pause(std::max(shortest, rarest * Seconds(end - begin).count()));
  memory_due_ = end + std::chrono::duration_cast<Clock::duration>(pause);
  const std::lock_guard lock(writing_);
  if (small_) remembered_.swap(state);
}

void StateKeeper::between_steps(const std::function<std::string()>& where) {
  if (const int signal = interrupt_signal()) throw Interrupted(signal, "stopped " + where());
  const auto now = Clock::now();
  if (interval_ > 0 && now >= disk_due_)
    save();
  else if (small_ && now >= memory_due_)
    remember();
}

std::string StateKeeper::kept() const {
  if (!on_disk_) return "nothing is kept: the same command begins anew";
  return fmt::format("the state is kept in {}; the same command goes on from there", checkpoint_.path());
}

std::string StateKeeper::save_the_remembered() {
  const std::lock_guard lock(writing_);
  if (ended_) return "stopped; " + kept();
  if (const auto state = std::exchange(remembered_, nullptr)) write(*state);
  return "stopped within a long step, whose beginning counts; " + kept();
}

void StateKeeper::keep_and_rethrow(const std::exception& error) {
  if (dynamic_cast<const InputError*>(&error)) throw;
  const auto* stop = dynamic_cast<const Interrupted*>(&error);
  try {
    // What failed within a step may have left half of it: then the last whole state counts.
    if (stop || dynamic_cast<const WriteError*>(&error)) save();
    const std::lock_guard lock(writing_);
    if (const auto state = std::exchange(remembered_, nullptr)) write(*state);
    ended_ = true;
  } catch (const std::exception& problem) {
    if (stop)
      throw Interrupted(stop->signal, fmt::format("{}; the state cannot be kept: {}", stop->what(), problem.what()));
  }
  if (on_disk_) say_(kept());
  throw;
}

}  // namespace crumble

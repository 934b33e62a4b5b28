// A breakup under way, with its error estimate, to the file.
#pragma once

#include <memory>

#include "breaker/breakup_checkpoint.hpp"
#include "breaker/companion.hpp"
#include "breaker/expected_cost.hpp"
#include "breaker/start.hpp"
#include "common/io/command_line.hpp"
#include "common/io/granule.hpp"
#include "common/io/program.hpp"
#include "common/io/provenance.hpp"
#include "common/io/state_keeper.hpp"

namespace crumble::breaker {

class Breaking {
 public:
  struct Job {
    const CommandLine& line;
    const Scene& text;
    const BreakerScene& scene;
    const Parent& parent;
    const Start& start;
    const Provenance& provenance;
    const ExpectedCost& cost;
    ProgressPrinter& progress;
    bool beside;  // the companion has a thread of its own
  };

  // Begins, or goes on from the checkpoint, if one was found.
  Breaking(const Job& job, const OutputCheckpoint& checkpoint);

  // To the end and into the file, again with half of the tolerance while the error is too large. Whatever stops it
  // early leaves a checkpoint.
  void finish();
  const BreakupRun& run() const { return *run_; }
  std::optional<double> companion() const { return saved_.progression.companion; }
  void forget() { frames_->remove(); }  // what only a restart would need

 private:
  std::unique_ptr<BreakupRun> make_run() const;
  void run_to_the_end();
  void advance();
  void between_steps();
  std::string where() const;  // it stands
  void put_frame();
  void put_sample();
  void record();
  bool is_uncertain() const;
  void begin_anew();
  void write();

  Job job_;
  SavedBreakup saved_;
  std::unique_ptr<BreakupRun> run_;
  std::unique_ptr<FrameLog> frames_;
  StateKeeper keeper_;
  std::unique_ptr<Companion> companion_;  // goes first: while its thread ends, the keeper knows what is kept
};

}  // namespace crumble::breaker

// A drying under way, from the error estimate to the file.
#pragma once

#include "common/io/command_line.hpp"
#include "common/io/program.hpp"
#include "common/io/provenance.hpp"
#include "common/io/state_keeper.hpp"
#include "dryer/drying_checkpoint.hpp"
#include "dryer/expected_cost.hpp"

namespace crumble::dryer {

class Drying {
 public:
  struct Job {
    const CommandLine& line;
    const Scene& text;
    const DryingScene& scene;
    const Provenance& provenance;
    const ExpectedCost& cost;
    ProgressPrinter& progress;
  };

  // Begins, or goes on from the checkpoint, if one was found.
  Drying(const Job& job, const OutputCheckpoint& checkpoint);

  // To the end and into the file. Whatever stops it early leaves a checkpoint.
  Morphology finish();
  const DryingRun& run() const { return *saved_.run; }
  const std::optional<DryingOutcome>& companion() const { return saved_.progress.companion; }
  void forget() { frames_->remove(); }  // what only a restart would need

 private:
  std::string name() const;
  void advance();
  void estimate();
  int frames_due() const;
  void run_to_the_end();
  void write(const Morphology& result);

  Job job_;
  SavedDrying saved_;
  std::unique_ptr<FrameLog> frames_;
  StateKeeper keeper_;
};

}  // namespace crumble::dryer

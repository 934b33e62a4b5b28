// What a drying run tells: frames in the file, the report, the table on the screen.
#pragma once

#include <optional>

#include "common/io/agglomerate_writer.hpp"
#include "common/io/frame_log.hpp"
#include "common/io/report.hpp"
#include "dryer/run.hpp"

namespace crumble::dryer {

void append_frame(FrameLog& frames, const DryingRun& run);
void write_errors(AgglomerateWriter& writer, const Morphology& m, const std::optional<DryingOutcome>& companion);
void write_morphology(AgglomerateWriter& writer, const Morphology& morphology);

// companion: outcome of the same run with doubled step control, if there was one.
void fill_report(Report& report, const DryingScene& scene, const DryingRun& run, const Morphology& morphology,
                 const std::optional<DryingOutcome>& companion);

// A few lines for the terminal.
std::string result_text(const Morphology& morphology, const std::optional<DryingOutcome>& companion);

}  // namespace crumble::dryer

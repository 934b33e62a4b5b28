// What a breakup tells: frames, series and events in the file, the report, the table on the screen.
#pragma once

#include <optional>

#include "breaker/run.hpp"
#include "breaker/start.hpp"
#include "common/io/agglomerate_writer.hpp"
#include "common/io/frame_log.hpp"
#include "common/io/report.hpp"

namespace crumble::breaker {

void append_frame(FrameLog& frames, const BreakupRun& run, const BreakerScene& scene);
void append_sample(FrameLog& frames, const BreakupRun& run);
// Closing, flow, events, critical stress and its error: once, at the end.
void write_rest(AgglomerateWriter& writer, const BreakupRun& run, const BreakerScene& scene, const Start& start,
                std::optional<double> companion);

// Relative change of a length from the start to shortly before breakup.
double change(double before, double initial);
// "brittle", "ductile" or "none".
std::string breakage(const Breakup& breakup, const BreakerScene& scene);

// companion: critical stress of the same run with coarser control, infinite where it did not break; nothing: there was
// none.
std::optional<double> relative_error(const Breakup& breakup, std::optional<double> companion);
void fill_report(Report& report, const BreakerScene& scene, const Start& start, const BreakupRun& run,
                 std::optional<double> companion);
// text: the scene as given.
GranuleStrength granule_strength(const BreakupRun& run, const BreakerScene& scene, const Scene& text,
                                 const Start& start, std::optional<double> companion);
std::string result_text(const BreakupRun& run, const BreakerScene& scene, std::optional<double> companion);

// What follows from scene and agglomerate before anything is run, a line each.
std::vector<std::string> describe(const BreakerScene& scene, const Start& start);

}  // namespace crumble::breaker

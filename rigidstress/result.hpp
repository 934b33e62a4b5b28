// What a run tells: the report for programs and the table for people.
#pragma once

#include <string>
#include <vector>

#include "common/io/report.hpp"
#include "rigidstress/analysis.hpp"

namespace crumble::rigidstress {

void fill_report(Report& report, const Analysis& analysis, const StressScene& scene);
// The weakest of the flows; text: the scene as given.
GranuleStrength granule_strength(const Analysis& analysis, const StressScene& scene, const Scene& text);

std::string result_text(const Analysis& analysis, const StressScene& scene);

// What closing did to the agglomerate, a line each.
std::vector<std::string> describe(const Prepared& prepared);

}  // namespace crumble::rigidstress

// The stress file: what a run found, in the agglomerate file's schema, and the response that a later run reuses.
#pragma once

#include <filesystem>
#include <optional>

#include "common/io/agglomerate_writer.hpp"
#include "rigidstress/analysis.hpp"

namespace crumble::rigidstress {

// Closed agglomerate, response and flows. Everything but a history is at a viscosity of 1 Pa s and a shear rate of 1/s.
void write_stress(AgglomerateWriter& writer, const Analysis& analysis, const StressScene& scene);

// The analysis without flows, if `file` is a stress file whose response was computed with what this scene asks for.
std::optional<Analysis> restore(const std::filesystem::path& file, const Scene& text, const StressScene& scene);

}  // namespace crumble::rigidstress

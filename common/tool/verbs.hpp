// The verbs of `agglomerate`. Each writes its answer to `out`, the result to its file, and returns the exit code.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "common/tool/options.hpp"

namespace crumble::tool {

// What was typed, for the provenance of what is written: the arguments of main.
using Typed = std::vector<std::string>;

int check(const CheckOptions& options, std::ostream& out);
// 0: no result differs by more than the errors that the files state; 1: one does.
int compare(const CompareOptions& options, std::ostream& out);
int info(const InfoOptions& options, std::ostream& out);
int import_file(const ImportFileOptions& options, const Typed& typed, std::ostream& out);
int export_frames(const ExportOptions& options, std::ostream& out);
int morphology(const MorphologyOptions& options, std::ostream& out);
int scale(const ScaleOptions& options, const Typed& typed, std::ostream& out);
int schema(std::ostream& out);

}  // namespace crumble::tool

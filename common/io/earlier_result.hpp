// What already stands where a program is about to write.
#pragma once

#include <string>

#include "common/io/provenance.hpp"

namespace crumble {

// Throws InputError where `output` is the finished result of another program, of another resolved scene or of another
// granule, or no result at all, naming what differs and --overwrite. The same scene may always run again. A granule is
// another if both the name and the content of its file are: one that was dried anew is still the same.
void require_no_other_result(const std::string& output, const Provenance& now, const std::string& resolved);

}  // namespace crumble

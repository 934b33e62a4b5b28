// What import and scale have in common: an agglomerate with freshly closed contacts, told and written.
#pragma once

#include <iosfwd>
#include <string>

#include "common/agglomerate/rescaled.hpp"
#include "common/io/output_lock.hpp"
#include "common/io/properties.hpp"
#include "common/io/provenance.hpp"

namespace crumble::tool {

// Throws InputError if the output cannot be written, is the input or is being written by another.
OwnedOutputs own_output(const std::string& output, const std::string& input);

// Self-stress that remains, contacts that were lost and pairs that came to touch, in words.
void tell(std::ostream& out, const Rescaled& result);

void write_closed(const std::string& file, const Rescaled& result, const Provenance& provenance,
                  const std::string& settings, const Properties& properties);

// The material as a TOML section, for the file's record of what it was made with.
std::string material_text(const Material& material);

}  // namespace crumble::tool

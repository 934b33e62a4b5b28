// What the fuzzers of scenes share.
#pragma once

#include "common/io/parameters.hpp"
#include "tests/fuzz/harness.hpp"

namespace crumble::fuzz {

// A scene that can be read is given to `use`; before that, what it resolves to must read back to the same.
std::string with_scene(std::string_view text, const ParameterTable& table,
                       const std::function<std::string(Scene&)>& use);

// Keys of the table with values that they may take, or nearly.
std::string mutated_scene(const std::string& text, const ParameterTable& table, Random& random);

}  // namespace crumble::fuzz

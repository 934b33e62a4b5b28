// What reads data of others, each as one function of the bytes. A function returns what came of them, in words; it
// throws where a reader did what it must not do: anything but an InputError or a FormatError of its own.
#pragma once

#include <functional>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>

namespace crumble::fuzz {

// Edits of a stored agglomerate file, one a line (edits.hpp): the checker and the reader must agree.
std::string file(std::string_view edits);

// Scenes: text, parameters, and what the programs make of them.
std::string dryer_scene(std::string_view text);
std::string breaker_scene(std::string_view text);
std::string rigidstress_scene(std::string_view text);

// Spheres as CSV and as XYZ, imported; a table of the velocity gradient.
std::string points(std::string_view text);
std::string history(std::string_view text);

// Changes a text in a way that its reader understands. Where there is none, libFuzzer changes bytes.
using Random = std::minstd_rand;
using Mutator = std::string (*)(const std::string& text, Random& random);
std::string mutated_edits(const std::string& edits, Random& random);
std::string mutated_dryer_scene(const std::string& text, Random& random);
std::string mutated_breaker_scene(const std::string& text, Random& random);
std::string mutated_rigidstress_scene(const std::string& text, Random& random);
std::string mutated_table(const std::string& text, Random& random);

// One of a few: what `work` returns, or the first line of what it threw as it may.
std::string outcome(const std::function<std::string()>& work);

// Ours is broken: reported as a crash.
struct Finding : std::logic_error {
  using std::logic_error::logic_error;
};

}  // namespace crumble::fuzz

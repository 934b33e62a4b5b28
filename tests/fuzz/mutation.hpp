// What the mutators share.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tests/fuzz/harness.hpp"

namespace crumble::fuzz {

std::size_t below(Random& random, std::size_t bound);

template <class T>
const T& one_of(Random& random, const std::vector<T>& list) {
  return list[below(random, list.size())];
}

// Numbers at which programs go wrong, and others.
std::string any_number(Random& random);

std::vector<std::string> lines_of(const std::string& text);
std::string text_of(const std::vector<std::string>& lines);

// Removes, doubles or swaps lines, changes a number in one, or puts in one of fresh(); the first `fixed` stay.
std::string mutated_lines(const std::string& text, Random& random, std::size_t fixed,
                          const std::function<std::string()>& fresh);

}  // namespace crumble::fuzz

// The checker's rules on numbers, for arrays whose form is right.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "common/io/form.hpp"

namespace crumble::check {

struct Context {
  const hdf5::Group& root;
  const schema::Sizes& sizes;
  const std::set<std::string>& sound;  // paths of the table whose form is right
  std::vector<Violation>& violations;

  bool has(const std::string& path) const { return sound.contains(path); }
  void add(std::string path, std::string expected, std::string found) const {
    violations.push_back({std::move(path), std::move(expected), std::move(found)});
  }
};

std::string place(const std::string& path, hdf5::Shape shape, std::uint64_t k);  // "path[1][3][0]" of the k-th value
std::string row(const std::string& path, std::uint64_t k);

void finite(const Context& context, const std::string& path);                            // of a dataset
void increasing(const Context& context, const std::string& group);                       // its step and time
void same_instants(const Context& context, const std::string& group);                    // as the positions have
void unit_length(const Context& context, const std::string& path, std::uint64_t width);  // rows of a dataset
void particles(const Context& context);
void contacts(const Context& context);
void parent(const Context& context, const std::filesystem::path& file);

// What the numbers mean, for files in which all of the above holds.
void ranges(const Context& context);   // of each array by itself
void frames(const Context& context);   // positions, contacts and what follows from them
void results(const Context& context);  // events, morphology, response and flows

}  // namespace crumble::check

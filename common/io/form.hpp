// Does what stands in a file have the kind, type, shape and unit that the schema gives it? One answer for the reader,
// which stops at the first difference, and the checker, which collects them.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "common/io/hdf5.hpp"
#include "common/io/schema.hpp"

namespace crumble {

struct Violation {
  std::string path, expected, found;
  std::string text() const { return path + ": expected " + expected + ", found " + found; }
};

namespace schema {

// Sizes that the symbols of the shapes stand for, each bound where it is met first. T, N, M and L hold for the whole
// file, the others for their group.
class Sizes {
 public:
  // Empty if the shape fits; else what was expected.
  std::string mismatch(const std::string& path, std::string_view expected, const hdf5::Shape& found);
  std::uint64_t of(const std::string& symbol) const;  // 0 if not met

 private:
  std::map<std::string, std::uint64_t> known_;
};

// `path` is an instance of `entry.path`. What is missing is a violation too.
std::vector<Violation> check_form(const hdf5::Group& root, const Entry& entry, const std::string& path, Sizes& sizes);

}  // namespace schema
}  // namespace crumble

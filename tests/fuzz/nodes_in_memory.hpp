// What a file holds, as a tree in memory of which any part can be changed.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "common/io/hdf5.hpp"

namespace crumble::hdf5::memory {

using Values = std::variant<std::vector<std::int32_t>, std::vector<std::int64_t>, std::vector<std::uint8_t>,
                            std::vector<std::uint64_t>, std::vector<double>, std::vector<std::string>>;

struct Array {
  Type type = Type::other;
  Shape shape;
  Values values;  // none as long as nothing has been written
};

struct Link {
  std::size_t node = 0;
  std::string target;  // of a soft link
};

struct Node {
  Kind kind = Kind::group;
  Array array;
  std::map<std::string, Array, std::less<>> attributes;
  std::map<std::string, Link, std::less<>> links;
};

// Nodes are copied when they are first changed. The first is the root.
using Nodes = std::vector<std::shared_ptr<Node>>;

// Those of the file that is open.
extern Nodes nodes;

const Node& node(Id id);
Node& changed(Id id);

// Soft links are followed, as many as HDF5 follows.
std::optional<std::size_t> found(Id from, std::string_view path);

// The group that a new object of this path goes to, with the groups on the way, and the name that it has there.
// WriteError, with `where` for its words: there is one already, or the way leads through something else.
std::pair<std::size_t, std::string> place_of(Id from, const std::string& path, bool with_groups,
                                             const std::string& where);
std::size_t added(Id from, const std::string& path, Node fresh, const std::string& where);

Values empty_values(Type type);

// What a file on the disk holds, by the library.
Nodes nodes_of_file(const std::string& file);

}  // namespace crumble::hdf5::memory

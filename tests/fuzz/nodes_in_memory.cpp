#include "tests/fuzz/nodes_in_memory.hpp"

namespace crumble::hdf5::memory {

Nodes nodes;

const Node& node(Id id) { return *nodes[static_cast<std::size_t>(id)]; }

Node& changed(Id id) {
  auto& pointer = nodes[static_cast<std::size_t>(id)];
  if (pointer.use_count() > 1) pointer = std::make_shared<Node>(*pointer);
  return *pointer;
}

namespace {

constexpr int most_links = 16;  // soft links on one way, as in HDF5

std::optional<std::size_t> found(std::size_t from, std::string_view path, int& links_left) {
  if (path.starts_with('/')) from = 0;
  while (!path.empty()) {
    const auto end = path.find('/');
    const std::string_view name = path.substr(0, end);
    path.remove_prefix(end == path.npos ? path.size() : end + 1);
    if (name.empty() || name == ".") continue;
    const Node& group = *nodes[from];
    const auto link = group.links.find(name);
    if (group.kind != Kind::group || link == group.links.end()) return std::nullopt;
    if (link->second.target.empty()) {
      from = link->second.node;
      continue;
    }
    if (links_left-- == 0) return std::nullopt;
    const auto there = found(from, link->second.target, links_left);
    if (!there) return std::nullopt;
    from = *there;
  }
  return from;
}

}  // namespace

std::optional<std::size_t> found(Id from, std::string_view path) {
  int links_left = most_links;
  return found(static_cast<std::size_t>(from), path, links_left);
}

Values empty_values(Type type) {
  switch (type) {
    case Type::int32:
      return std::vector<std::int32_t>();
    case Type::int64:
      return std::vector<std::int64_t>();
    case Type::uint8:
      return std::vector<std::uint8_t>();
    case Type::uint64:
      return std::vector<std::uint64_t>();
    case Type::text:
      return std::vector<std::string>();
    default:
      return std::vector<double>();
  }
}

std::pair<std::size_t, std::string> place_of(Id from, const std::string& path, bool with_groups,
                                             const std::string& where) {
  const auto slash = path.find_last_not_of('/') == path.npos ? path.npos : path.rfind('/', path.find_last_not_of('/'));
  std::size_t parent = path.starts_with('/') ? 0 : static_cast<std::size_t>(from);
  const std::string name = slash == path.npos ? path : path.substr(slash + 1);
  if (slash != path.npos && slash > 0) {
    std::string_view rest = std::string_view(path).substr(0, slash);
    while (!rest.empty()) {
      const auto end = rest.find('/');
      const std::string part(rest.substr(0, end));
      rest.remove_prefix(end == rest.npos ? rest.size() : end + 1);
      if (part.empty()) continue;
      auto next = found(static_cast<Id>(parent), part);
      if (!next) {
        if (!with_groups || nodes[parent]->kind != Kind::group || nodes[parent]->links.contains(part))
          throw WriteError(where);
        changed(static_cast<Id>(parent)).links[part] = {nodes.size(), ""};
        next = nodes.size();
        nodes.push_back(std::make_shared<Node>());
      }
      parent = *next;
    }
  }
  if (name.empty() || name == "." || nodes[parent]->kind != Kind::group || nodes[parent]->links.contains(name))
    throw WriteError(where);
  return {parent, name};
}

std::size_t added(Id from, const std::string& path, Node fresh, const std::string& where) {
  const auto [parent, name] = place_of(from, path, true, where);
  changed(static_cast<Id>(parent)).links[name] = {nodes.size(), ""};
  nodes.push_back(std::make_shared<Node>(std::move(fresh)));
  return nodes.size() - 1;
}

}  // namespace crumble::hdf5::memory

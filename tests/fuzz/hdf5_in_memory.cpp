// The typed layer of common/io/hdf5.hpp over arrays in memory. The HDF5 library takes some 3 us a call, 10 ms to check
// a file of eight particles: too long for a million files. What is linked with this file has it in place of hdf5.cpp
// and hdf5_group.cpp; a test compares what both make of every file of the corpus.
#include <fmt/format.h>

#define H5O_info_t_vers 1
#include <hdf5.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <variant>

#include "common/io/hdf5.hpp"
#include "common/io/in_child.hpp"
#include "tests/fuzz/edits.hpp"

namespace crumble::hdf5 {

namespace {

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
Nodes nodes;

const Node& node(Id id) { return *nodes[static_cast<std::size_t>(id)]; }

Node& changed(Id id) {
  auto& pointer = nodes[static_cast<std::size_t>(id)];
  if (pointer.use_count() > 1) pointer = std::make_shared<Node>(*pointer);
  return *pointer;
}

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

std::size_t size_of(Type type) {
  return type == Type::int32 ? 4 : type == Type::uint8 ? 1 : type == Type::text ? 16 : 8;
}

// As the library converts: what is out of range becomes the nearest there is.
template <class T, class From>
T converted(From value) {
  if constexpr (std::is_same_v<T, From> || std::is_floating_point_v<T>) {
    return static_cast<T>(value);
  } else if constexpr (std::is_floating_point_v<From>) {
    if (std::isnan(value)) return 0;
    if (value <= static_cast<From>(std::numeric_limits<T>::min())) return std::numeric_limits<T>::min();
    if (value >= static_cast<From>(std::numeric_limits<T>::max())) return std::numeric_limits<T>::max();
    return static_cast<T>(value);
  } else {
    if (std::cmp_less(value, std::numeric_limits<T>::min())) return std::numeric_limits<T>::min();
    if (std::cmp_greater(value, std::numeric_limits<T>::max())) return std::numeric_limits<T>::max();
    return static_cast<T>(value);
  }
}

template <class T>
std::vector<T> numbers(const Array& array, std::uint64_t first, std::uint64_t count, const std::string& where) {
  if (array.type == Type::text || array.type == Type::other) throw ContentError(where);
  return std::visit(
      [&]<class From>(const std::vector<From>& values) {
        std::vector<T> result;
        result.reserve(count);
        if constexpr (!std::is_same_v<From, std::string>)
          for (std::uint64_t k = first; k < first + count; ++k)
            result.push_back(converted<T>(k < values.size() ? values[k] : From()));
        return result;
      },
      array.values);
}

// What a file holds, by the library.
class Reading {
 public:
  explicit Reading(const std::string& file) {
    const Handle opened(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    if (opened.get() < 0) throw OpenError(file + ": cannot be opened");
    const Handle root(H5Gopen2(opened.get(), "/", H5P_DEFAULT), H5Gclose);
    nodes_.push_back(std::make_shared<Node>());
    group(root.get(), 0);
  }
  Nodes nodes() { return std::move(nodes_); }

 private:
  void group(Id id, std::size_t place) {
    attributes(id, place);
    std::vector<std::string> names;
    H5Literate(
        id, H5_INDEX_NAME, H5_ITER_INC, nullptr,
        [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
          static_cast<std::vector<std::string>*>(out)->emplace_back(name);
          return 0;
        },
        &names);
    for (const std::string& name : names) nodes_[place]->links[name] = link(id, name);
  }

  Link link(Id parent, const std::string& name) {
    H5L_info_t info;
    H5Lget_info(parent, name.c_str(), &info, H5P_DEFAULT);
    if (info.type == H5L_TYPE_SOFT) {
      std::string target(info.u.val_size, '\0');
      H5Lget_val(parent, name.c_str(), target.data(), target.size(), H5P_DEFAULT);
      return {0, target.c_str()};
    }
    const Handle object(H5Oopen(parent, name.c_str(), H5P_DEFAULT), H5Oclose);
    H5O_info_t about;
    H5Oget_info2(object.get(), &about, H5O_INFO_BASIC);
    const auto [known, fresh] = known_.emplace(about.addr, nodes_.size());
    if (!fresh) return {known->second, ""};
    const std::size_t place = known->second;
    nodes_.push_back(std::make_shared<Node>());
    if (about.type == H5O_TYPE_GROUP) {
      group(object.get(), place);
    } else {
      nodes_[place]->kind = Kind::dataset;
      const Handle type(H5Dget_type(object.get()), H5Tclose), space(H5Dget_space(object.get()), H5Sclose);
      nodes_[place]->array = array(type.get(), space.get(), [&](Id memory, void* out) {
        H5Dread(object.get(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, out);
      });
      attributes(object.get(), place);
    }
    return {place, ""};
  }

  void attributes(Id id, std::size_t place) {
    std::vector<std::string> names;
    H5Aiterate2(
        id, H5_INDEX_NAME, H5_ITER_INC, nullptr,
        [](hid_t, const char* name, const H5A_info_t*, void* out) -> herr_t {
          static_cast<std::vector<std::string>*>(out)->emplace_back(name);
          return 0;
        },
        &names);
    for (const std::string& name : names) {
      const Handle attribute(H5Aopen(id, name.c_str(), H5P_DEFAULT), H5Aclose);
      const Handle type(H5Aget_type(attribute.get()), H5Tclose), space(H5Aget_space(attribute.get()), H5Sclose);
      nodes_[place]->attributes[name] =
          array(type.get(), space.get(), [&](Id memory, void* out) { H5Aread(attribute.get(), memory, out); });
    }
  }

  template <class Read>
  static Array array(Id type, Id space, Read read) {
    Array result;
    const int rank = H5Sget_simple_extent_ndims(space);
    result.shape.resize(rank > 0 ? rank : 0);
    if (rank > 0) H5Sget_simple_extent_dims(space, reinterpret_cast<hsize_t*>(result.shape.data()), nullptr);
    const auto count = element_count(result.shape);
    if (H5Tget_class(type) == H5T_STRING) {
      result.type = Type::text;
      result.values = texts(type, count, read);
    } else {
      numbers(result, type, count, read, Type::int32, H5T_NATIVE_INT32);
      numbers(result, type, count, read, Type::int64, H5T_NATIVE_INT64);
      numbers(result, type, count, read, Type::uint8, H5T_NATIVE_UINT8);
      numbers(result, type, count, read, Type::uint64, H5T_NATIVE_UINT64);
      numbers(result, type, count, read, Type::float64, H5T_NATIVE_DOUBLE);
    }
    return result;
  }

  // If the array is of this type.
  template <class Read>
  static void numbers(Array& result, Id type, std::uint64_t count, Read read, Type candidate, Id memory) {
    if (H5Tequal(type, memory) <= 0) return;
    result.type = candidate;
    result.values = empty_values(candidate);
    std::visit(
        [&]<class T>(std::vector<T>& values) {
          values.resize(count);
          if constexpr (!std::is_same_v<T, std::string>)
            if (count > 0) read(memory, values.data());
        },
        result.values);
  }

  template <class Read>
  static std::vector<std::string> texts(Id type, std::uint64_t count, Read read) {
    std::vector<std::string> result;
    if (H5Tis_variable_str(type) > 0) {
      std::vector<char*> pointers(count, nullptr);
      read(type, pointers.data());
      for (char* text : pointers) {
        result.emplace_back(text ? text : "");
        H5free_memory(text);
      }
      return result;
    }
    const std::size_t width = H5Tget_size(type);
    std::vector<char> letters(count * width);
    read(type, letters.data());
    for (std::uint64_t k = 0; k < count; ++k)
      result.emplace_back(letters.data() + k * width, strnlen(letters.data() + k * width, width));
    return result;
  }

  Nodes nodes_;
  std::map<haddr_t, std::size_t> known_;
};

// The group that a new object of this path goes to, with the groups on the way, and the name that it has there.
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

Handle handle(std::size_t place) { return {static_cast<Id>(place), nullptr}; }

// As a C string holds it.
std::string c_text(std::string_view text) { return std::string(text.substr(0, text.find('\0'))); }

}  // namespace

std::string library_version() { return "in memory"; }

bool Object::same_object(const Object& other) const { return id() == other.id(); }

bool Object::has_attribute(std::string_view name) const { return node(id()).attributes.contains(name); }

// The attribute itself is looked up by the functions below.
Handle Object::open_attribute(std::string_view name) const {
  if (!has_attribute(name)) throw ContentError(place("@" + std::string(name)) + ": cannot read the attribute");
  return {};
}

Type Object::attribute_type(std::string_view name) const {
  open_attribute(name);
  return node(id()).attributes.find(name)->second.type;
}

Shape Object::attribute_shape(std::string_view name) const {
  open_attribute(name);
  return node(id()).attributes.find(name)->second.shape;
}

std::vector<std::string> Object::text_attribute(std::string_view name) const {
  open_attribute(name);
  const Array& array = node(id()).attributes.find(name)->second;
  if (array.type != Type::text)
    throw ContentError(place("@" + std::string(name)) + ": expected text, found another type");
  return std::get<std::vector<std::string>>(array.values);
}

template <class T>
std::vector<T> Object::attribute(std::string_view name) const {
  open_attribute(name);
  const Array& array = node(id()).attributes.find(name)->second;
  return numbers<T>(array, 0, element_count(array.shape),
                    place("@" + std::string(name)) + ": cannot read the attribute");
}

void Object::set_text_attribute(std::string_view name, const std::vector<std::string>& values) {
  std::vector<std::string> texts;
  for (const std::string& value : values) texts.push_back(c_text(value));
  changed(id()).attributes[std::string(name)] = {Type::text, {values.size()}, texts};
}

void Object::set_attribute(std::string_view name, std::string_view value) {
  changed(id()).attributes[std::string(name)] = {Type::text, {}, std::vector<std::string>{c_text(value)}};
}

template <class T>
void Object::set_attribute(std::string_view name, std::span<const T> values, bool scalar) {
  Shape shape;
  if (!scalar) shape = {values.size()};
  changed(id()).attributes[std::string(name)] = {type_of<T>(), shape, std::vector<T>(values.begin(), values.end())};
}

Shape Dataset::shape() const { return node(id()).array.shape; }

Type Dataset::type() const { return node(id()).array.type; }

bool Dataset::is_stored() const {
  const Array& array = node(id()).array;
  const std::size_t element = size_of(array.type);
  std::uint64_t bytes = 0;
  if (__builtin_mul_overflow(element_count(array.shape), element, &bytes)) return false;
  return bytes <= element * std::visit([](const auto& values) { return values.size(); }, array.values);
}

template <class T>
std::vector<T> Dataset::read() const {
  const Shape size = shape();
  return read_rows<T>(0, size.empty() ? 1 : size[0]);
}

template <class T>
std::vector<T> Dataset::read_rows(std::uint64_t first, std::uint64_t count) const {
  const Array& array = node(id()).array;
  Shape size = array.shape;
  if (!is_stored())
    throw ContentError(
        fmt::format("{}: declares {} but the file does not hold that much", place(""), shape_text(size)));
  if (!size.empty()) {
    if (first > size[0] || count > size[0] - first)
      throw ContentError(
          fmt::format("{}: rows {} to {} do not exist, it has {}", place(""), first, first + count, size[0]));
    size[0] = count;
  }
  const std::uint64_t row = size.empty() || count == 0 ? 0 : element_count(size) / count;
  return numbers<T>(array, first * row, element_count(size), place("") + ": cannot read");
}

std::string Dataset::read_text() const {
  const Array& array = node(id()).array;
  if (array.type != Type::text || !array.shape.empty())
    throw ContentError(place("") + ": expected one text, found another type");
  const auto& texts = std::get<std::vector<std::string>>(array.values);
  return texts.empty() ? "" : texts.front();
}

template <class T>
void Dataset::write(std::span<const T> values) {
  Array& array = changed(id()).array;
  if (values.size() != element_count(array.shape)) throw std::logic_error(place("") + ": wrong number of values");
  if (array.type == Type::text || array.type == Type::other) throw WriteError(place("") + ": cannot write");
  std::visit(
      [&]<class To>(std::vector<To>& stored) {
        stored.clear();
        if constexpr (!std::is_same_v<To, std::string>)
          for (const T value : values) stored.push_back(converted<To>(value));
      },
      array.values);
}

void Dataset::resize_rows(std::uint64_t rows) { changed(id()).array.shape.at(0) = rows; }

Kind Group::kind(std::string_view path) const {
  const auto there = found(id(), path);
  return there ? nodes[*there]->kind : Kind::missing;
}

std::vector<std::string> Group::names() const {
  std::vector<std::string> names;
  for (const auto& [name, link] : node(id()).links) names.push_back(name);
  return names;
}

Group Group::group(std::string_view path) const {
  const auto there = found(id(), path);
  if (!there || nodes[*there]->kind != Kind::group) throw ContentError(place(path) + ": expected a group");
  return {handle(*there), file_, place(path).substr(file_.size() + 2)};
}

Dataset Group::dataset(std::string_view path) const {
  const auto there = found(id(), path);
  if (!there || nodes[*there]->kind != Kind::dataset) throw ContentError(place(path) + ": expected a dataset");
  return {handle(*there), file_, place(path).substr(file_.size() + 2)};
}

std::string Group::soft_link_target(std::string_view path) const {
  const auto slash = path.rfind('/');
  const auto parent = slash == path.npos ? found(id(), ".") : found(id(), path.substr(0, slash + 1));
  if (!parent) return "";
  const auto link = nodes[*parent]->links.find(slash == path.npos ? path : path.substr(slash + 1));
  return link == nodes[*parent]->links.end() ? "" : link->second.target;
}

Group Group::create_group(std::string_view path) {
  const std::string text(path);
  if (kind(text) == Kind::group) return group(text);
  const std::size_t place_there = added(id(), text, {}, place(text) + ": cannot create the group");
  return {handle(place_there), file_, place(text).substr(file_.size() + 2)};
}

template <class T>
Dataset Group::create_dataset(std::string_view path, const Shape& shape, std::uint64_t) {
  const std::string text(path);
  Node fresh{Kind::dataset, {type_of<T>(), shape, empty_values(type_of<T>())}, {}, {}};
  const std::size_t place_there = added(id(), text, std::move(fresh), place(text) + ": cannot create the dataset");
  return {handle(place_there), file_, place(text).substr(file_.size() + 2)};
}

void Group::write_text(std::string_view path, std::string_view text) {
  const std::string name(path);
  Node fresh{Kind::dataset, {Type::text, {}, std::vector<std::string>{c_text(text)}}, {}, {}};
  added(id(), name, std::move(fresh), place(name) + ": cannot create the dataset");
}

void Group::soft_link(std::string_view target, std::string_view path) {
  const auto [parent, name] = place_of(id(), std::string(path), false, place(path) + ": cannot create the link");
  changed(static_cast<Id>(parent)).links[name] = {0, std::string(target)};
}

void Group::hard_link(std::string_view target, std::string_view path) {
  const std::string where = place(path) + ": cannot create the link";
  const auto there = found(id(), target);
  if (!there) throw WriteError(where);
  const auto [parent, name] = place_of(id(), std::string(path), false, where);
  changed(static_cast<Id>(parent)).links[name] = {*there, ""};
}

void Group::unlink(std::string_view path) {
  const auto slash = path.rfind('/');
  const auto parent = slash == path.npos ? found(id(), ".") : found(id(), path.substr(0, slash + 1));
  const std::string name(slash == path.npos ? path : path.substr(slash + 1));
  if (!parent || !nodes[*parent]->links.contains(name)) throw WriteError(place(path) + ": cannot remove it");
  changed(static_cast<Id>(*parent)).links.erase(name);
}

File File::open_with(const std::filesystem::path& path, unsigned) {
  File file;
  file.file_ = path.string();
  file.handle_ = handle(0);
  return file;
}

File File::open(const std::filesystem::path& path) { return open_with(path, 0); }
File File::modify(const std::filesystem::path& path) { return open_with(path, 0); }
void File::close() {}

#define CRUMBLE_IN_MEMORY_TYPE(T)                                                     \
  template std::vector<T> Object::attribute<T>(std::string_view) const;               \
  template void Object::set_attribute<T>(std::string_view, std::span<const T>, bool); \
  template std::vector<T> Dataset::read<T>() const;                                   \
  template std::vector<T> Dataset::read_rows<T>(std::uint64_t, std::uint64_t) const;  \
  template void Dataset::write<T>(std::span<const T>);                                \
  template Dataset Group::create_dataset<T>(std::string_view, const Shape&, std::uint64_t);
CRUMBLE_IN_MEMORY_TYPE(std::int32_t)
CRUMBLE_IN_MEMORY_TYPE(std::int64_t)
CRUMBLE_IN_MEMORY_TYPE(std::uint8_t)
CRUMBLE_IN_MEMORY_TYPE(std::uint64_t)
CRUMBLE_IN_MEMORY_TYPE(double)
#undef CRUMBLE_IN_MEMORY_TYPE

}  // namespace crumble::hdf5

namespace crumble {

// No library, nothing that a child process would be needed for.
std::string in_child(const std::filesystem::path&, const std::function<std::string()>& work) { return work(); }

}  // namespace crumble

namespace crumble::fuzz {

std::filesystem::path copy_of(const std::filesystem::path& sample) {
  static std::map<std::string, hdf5::Nodes> samples;
  const auto [known, fresh] = samples.try_emplace(sample.string());
  if (fresh) known->second = hdf5::Reading(sample.string()).nodes();
  hdf5::nodes = known->second;
  return sample;
}

}  // namespace crumble::fuzz

// The typed layer of common/io/hdf5.hpp over arrays in memory. The HDF5 library takes some 3 us a call, 10 ms to check
// a file of eight particles: too long for a million files. What is linked with this file has it in place of hdf5.cpp
// and hdf5_group.cpp; a test compares what both make of every file of the corpus.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "common/io/hdf5.hpp"
#include "common/io/in_child.hpp"
#include "tests/fuzz/edits.hpp"
#include "tests/fuzz/nodes_in_memory.hpp"

namespace crumble::hdf5 {

using namespace memory;

namespace {

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
std::vector<T> Dataset::read_rows(std::uint64_t first, std::uint64_t count) const {
  const Array& array = node(id()).array;
  const Shape size = shape_of_rows(first, count);
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
  static std::map<std::string, hdf5::memory::Nodes> samples;
  const auto [known, fresh] = samples.try_emplace(sample.string());
  if (fresh) known->second = hdf5::memory::nodes_of_file(sample.string());
  hdf5::memory::nodes = known->second;
  return sample;
}

}  // namespace crumble::fuzz

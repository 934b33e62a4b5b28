// What needs no library: names for messages, sizes, which rows there are, and identifiers that close themselves.
#include <fmt/format.h>

#include "common/io/hdf5.hpp"

namespace crumble::hdf5 {

std::string_view type_name(Type type) {
  switch (type) {
    case Type::int32:
      return "int32";
    case Type::int64:
      return "int64";
    case Type::uint8:
      return "uint8";
    case Type::uint64:
      return "uint64";
    case Type::float64:
      return "float64";
    case Type::text:
      return "text";
    case Type::other:
      break;
  }
  return "another type";
}

std::string shape_text(const Shape& shape) {
  if (shape.empty()) return "scalar";
  std::string text;
  for (auto size : shape) text += fmt::format("[{}]", size);
  return text;
}

std::uint64_t element_count(const Shape& shape) {
  std::uint64_t count = 1;
  for (auto size : shape)
    if (__builtin_mul_overflow(count, size, &count)) return UINT64_MAX;
  return count;
}

Handle& Handle::operator=(Handle&& other) noexcept {
  if (this != &other) {
    reset();
    id_ = std::exchange(other.id_, -1);
    close_ = other.close_;
  }
  return *this;
}

bool Handle::reset() {
  const Id id = std::exchange(id_, -1);
  return id < 0 || !close_ || close_(id) >= 0;
}

std::string Object::place(std::string_view name) const {
  if (name.empty()) return file_ + ": " + (path_.empty() ? "/" : path_);
  const std::string separator = name.front() == '/' || name.front() == '@' ? "" : "/";
  return fmt::format("{}: {}{}{}", file_, path_, separator, name);
}

Shape Dataset::shape_of_rows(std::uint64_t first, std::uint64_t count) const {
  Shape size = shape();
  if (!is_stored())
    throw ContentError(
        fmt::format("{}: declares {} but the file does not hold that much", place(""), shape_text(size)));
  if (!size.empty()) {
    if (first > size[0] || count > size[0] - first)
      throw ContentError(
          fmt::format("{}: rows {} to {} do not exist, it has {}", place(""), first, first + count, size[0]));
    size[0] = count;
  }
  return size;
}

}  // namespace crumble::hdf5

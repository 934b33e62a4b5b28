// A thin typed layer over the HDF5 C API: identifiers that close themselves, typed reading and writing, and
// exceptions that name file and path instead of the library's own printed error stack.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/io/file_errors.hpp"

namespace crumble::hdf5 {

using Id = std::int64_t;  // hid_t, without its header
using Shape = std::vector<std::uint64_t>;

// The element types that we store. `other` is anything else that a foreign file may hold.
enum class Type { int32, int64, uint8, uint64, float64, text, other };
template <class T>
constexpr Type type_of();
std::string library_version();
std::string_view type_name(Type type);
std::string shape_text(const Shape& shape);  // "[3][115]", "scalar"
std::uint64_t element_count(const Shape& shape);

enum class Kind { missing, group, dataset, other };

class Handle {
 public:
  using Close = int (*)(Id);
  Handle() = default;
  Handle(Id id, Close close) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept;
  ~Handle() { reset(); }
  Id get() const { return id_; }
  bool reset();  // false if the library failed to close

 private:
  Id id_ = -1;
  Close close_ = nullptr;
};

// What groups and datasets share: a name to blame, and attributes.
class Object {
 public:
  const std::string& path() const { return path_; }
  bool has_attribute(std::string_view name) const;
  Type attribute_type(std::string_view name) const;
  Shape attribute_shape(std::string_view name) const;
  std::vector<std::string> text_attribute(std::string_view name) const;  // one string for each element
  template <class T>
  std::vector<T> attribute(std::string_view name) const;
  void set_text_attribute(std::string_view name, const std::vector<std::string>& values);  // [] of strings
  void set_attribute(std::string_view name, std::string_view value);                       // one string
  void set_fixed_text_attribute(std::string_view name, std::string_view value);  // for readers that want fixed length
  template <class T>
  void set_attribute(std::string_view name, std::span<const T> values, bool scalar = false);
  void set_reference_attribute(std::string_view name, std::string_view target);  // object reference
  Id id() const { return handle_.get(); }
  bool same_object(const Object& other) const;  // reached by hard links

 protected:
  Object() = default;
  Object(Handle handle, std::string file, std::string path)
      : handle_(std::move(handle)), file_(std::move(file)), path_(std::move(path)) {}
  std::string place(std::string_view name) const;  // "file.h5: /path/name"
  Handle open_attribute(std::string_view name) const;
  void write_attribute(std::string_view name, Id type, const Shape& shape, bool scalar, const void* data);
  Handle handle_;
  std::string file_, path_;
};

class Dataset : public Object {
 public:
  Dataset() = default;
  Dataset(Handle handle, std::string file, std::string path) : Object(std::move(handle), std::move(file), path) {}
  Shape shape() const;
  Type type() const;
  // False if the declared size cannot be in the file: such a dataset must not be read (memory).
  bool is_stored() const;
  template <class T>
  std::vector<T> read() const {
    const Shape size = shape();
    return read_rows<T>(0, size.empty() ? 1 : size[0]);
  }
  template <class T>
  std::vector<T> read_rows(std::uint64_t first, std::uint64_t count) const;  // along the first dimension
  std::string read_text() const;
  template <class T>
  void write(std::span<const T> values);
  template <class T>
  void append_rows(std::uint64_t rows, std::span<const T> values);
  void resize_rows(std::uint64_t rows);

 private:
  Shape shape_of_rows(std::uint64_t first, std::uint64_t count) const;  // ContentError: they are not there
  void transfer(bool writing, Id memory_type, std::uint64_t first, std::uint64_t count, void* data) const;
};

class Group : public Object {
 public:
  Group() = default;
  Group(Handle handle, std::string file, std::string path) : Object(std::move(handle), std::move(file), path) {}
  Kind kind(std::string_view path) const;  // soft links are followed; a dangling or cyclic one is `missing`
  std::vector<std::string> names() const;  // of the links in this group, sorted
  Group group(std::string_view path) const;
  Dataset dataset(std::string_view path) const;
  std::string soft_link_target(std::string_view path) const;  // empty if it is not a soft link
  Group create_group(std::string_view path);                  // with the groups above it; may exist already
  // Grows along the first dimension if rows_of_chunk > 0.
  template <class T>
  Dataset create_dataset(std::string_view path, const Shape& shape, std::uint64_t rows_of_chunk = 0);
  void write_text(std::string_view path, std::string_view text);
  void soft_link(std::string_view target, std::string_view path);
  void hard_link(std::string_view target, std::string_view path);
  void unlink(std::string_view path);
};

class File : public Group {
 public:
  File() = default;
  static File open(const std::filesystem::path& path);
  static File modify(const std::filesystem::path& path);
  static File create(const std::filesystem::path& path);  // replaces
  void flush();
  void close();

 private:
  static File open_with(const std::filesystem::path& path, unsigned flags);
};

template <>
constexpr Type type_of<std::int32_t>() {
  return Type::int32;
}
template <>
constexpr Type type_of<std::int64_t>() {
  return Type::int64;
}
template <>
constexpr Type type_of<std::uint8_t>() {
  return Type::uint8;
}
template <>
constexpr Type type_of<std::uint64_t>() {
  return Type::uint64;
}
template <>
constexpr Type type_of<double>() {
  return Type::float64;
}

}  // namespace crumble::hdf5

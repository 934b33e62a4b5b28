#include "common/io/hdf5.hpp"

#include <algorithm>
#include <cstring>

#include "common/io/hdf5_detail.hpp"

namespace crumble::hdf5 {

namespace detail {

Id native(Type type) {
  switch (type) {
    case Type::int32:
      return H5T_NATIVE_INT32;
    case Type::int64:
      return H5T_NATIVE_INT64;
    case Type::uint8:
      return H5T_NATIVE_UINT8;
    case Type::uint64:
      return H5T_NATIVE_UINT64;
    case Type::float64:
      return H5T_NATIVE_DOUBLE;
    default:
      throw std::logic_error("hdf5: no native type for text");
  }
}

Handle text_type() {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), H5T_VARIABLE);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  return type;
}

namespace {

// Where a write has failed, the library cannot close the file, and would at the end of the program touch what it has
// freed (HDF5 1.10.8: H5F__close_cb). We close all that we open, so that nothing is left to be done then.
[[maybe_unused]] const herr_t no_cleanup_at_exit = H5dont_atexit();

// "file write failed: time = ..., errno = 28, error message = 'No space left on device', buf = ..." -> what matters.
std::string system_error_in(const std::string& text) {
  constexpr std::string_view mark = "error message = '";
  const auto begin = text.find(mark);
  if (begin == text.npos) return "";
  return text.substr(begin + mark.size(), text.find('\'', begin + mark.size()) - begin - mark.size());
}

}  // namespace

std::string reason() {
  std::string text;
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_DOWNWARD,
      [](unsigned, const H5E_error2_t* error, void* out) -> herr_t {
        if (error->desc) *static_cast<std::string*>(out) = error->desc;
        return 0;
      },
      &text);
  H5Eclear2(H5E_DEFAULT);
  if (text.empty()) return "";
  const std::string system = system_error_in(text);
  return system.empty() ? " (HDF5: " + text + ")" : ": " + system;
}

void silence() {
  static const herr_t once = (H5open(), H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr));
  (void)once;
}

Type type_of_id(Id type) {
  if (H5Tget_class(type) == H5T_STRING) return Type::text;
  for (Type candidate : {Type::int32, Type::int64, Type::uint8, Type::uint64, Type::float64})
    if (H5Tequal(type, native(candidate)) > 0) return candidate;
  return Type::other;
}

Shape shape_of_space(Id space) {
  const int rank = H5Sget_simple_extent_ndims(space);
  Shape shape(rank > 0 ? rank : 0);
  if (rank > 0) H5Sget_simple_extent_dims(space, reinterpret_cast<hsize_t*>(shape.data()), nullptr);
  return shape;
}

Handle make_space(const Shape& shape, bool growing) {
  if (shape.empty()) return {H5Screate(H5S_SCALAR), H5Sclose};
  std::vector<hsize_t> size(shape.begin(), shape.end()), limit = size;
  if (growing) limit[0] = H5S_UNLIMITED;
  return {H5Screate_simple(static_cast<int>(size.size()), size.data(), limit.data()), H5Sclose};
}

}  // namespace detail

using namespace detail;

namespace {

// Reads `count` strings of either kind, fixed or variable length; `read` does the transfer into the buffer.
template <class Read>
std::vector<std::string> read_strings(Id file_type, std::uint64_t count, std::uint64_t limit, Read read) {
  std::vector<std::string> texts;
  if (H5Tis_variable_str(file_type) > 0) {
    Handle type = text_type();
    H5Tset_cset(type.get(), H5Tget_cset(file_type));
    std::vector<char*> buffer(count, nullptr);
    read(type.get(), buffer.data());
    for (char* text : buffer) {
      texts.emplace_back(text ? text : "");
      H5free_memory(text);
    }
    return texts;
  }
  const std::uint64_t width = H5Tget_size(file_type);
  if (width == 0 || width > limit / std::max<std::uint64_t>(count, 1)) throw ContentError("impossible text length");
  std::vector<char> buffer(count * width);
  Handle type(H5Tcopy(file_type), H5Tclose);
  read(type.get(), buffer.data());
  for (std::uint64_t k = 0; k < count; ++k) {
    const char* text = buffer.data() + k * width;
    texts.emplace_back(text, strnlen(text, width));
  }
  return texts;
}

std::uint64_t size_of_file(Id object) {
  const Handle file(H5Iget_file_id(object), H5Fclose);
  hsize_t size = 0;
  return H5Fget_filesize(file.get(), &size) < 0 ? 0 : size;
}

}  // namespace

std::string library_version() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return fmt::format("{}.{}.{}", major, minor, release);
}

bool Object::same_object(const Object& other) const {
  H5O_info_t a, b;
  return H5Oget_info2(id(), &a, H5O_INFO_BASIC) >= 0 && H5Oget_info2(other.id(), &b, H5O_INFO_BASIC) >= 0 &&
         a.fileno == b.fileno && a.addr == b.addr;
}

bool Object::has_attribute(std::string_view name) const { return H5Aexists(id(), std::string(name).c_str()) > 0; }

Handle Object::open_attribute(std::string_view name) const {
  return {checked<ContentError>(H5Aopen(id(), std::string(name).c_str(), H5P_DEFAULT), place("@" + std::string(name)),
                                "cannot read the attribute"),
          H5Aclose};
}

Type Object::attribute_type(std::string_view name) const {
  const Handle attribute = open_attribute(name);
  return type_of_id(Handle(H5Aget_type(attribute.get()), H5Tclose).get());
}

Shape Object::attribute_shape(std::string_view name) const {
  const Handle attribute = open_attribute(name);
  return shape_of_space(Handle(H5Aget_space(attribute.get()), H5Sclose).get());
}

std::vector<std::string> Object::text_attribute(std::string_view name) const {
  const Handle attribute = open_attribute(name);
  const Handle type(H5Aget_type(attribute.get()), H5Tclose);
  const std::string where = place("@" + std::string(name));
  if (type_of_id(type.get()) != Type::text) throw ContentError(where + ": expected text, found another type");
  const auto count = element_count(attribute_shape(name));
  if (count > attribute_limit) throw ContentError(where + ": impossible size");
  return read_strings(type.get(), count, attribute_limit, [&](Id memory, void* buffer) {
    checked<ContentError>(H5Aread(attribute.get(), memory, buffer), where, "cannot read the attribute");
  });
}

template <class T>
std::vector<T> Object::attribute(std::string_view name) const {
  const Handle attribute = open_attribute(name);
  const std::string where = place("@" + std::string(name));
  const auto count = element_count(attribute_shape(name));
  if (count > attribute_limit) throw ContentError(where + ": impossible size");
  std::vector<T> values(count);
  checked<ContentError>(H5Aread(attribute.get(), native(type_of<T>()), values.data()), where,
                        "cannot read the attribute");
  return values;
}

void Object::write_attribute(std::string_view name, Id type, const Shape& shape, bool scalar, const void* data) {
  const std::string text(name), where = place("@" + text);
  if (has_attribute(name)) H5Adelete(id(), text.c_str());
  const Handle space = make_space(scalar ? Shape{} : shape, false);
  const Handle attribute(
      checked<WriteError>(H5Acreate2(id(), text.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT), where,
                          "cannot create the attribute"),
      H5Aclose);
  checked<WriteError>(H5Awrite(attribute.get(), type, data), where, "cannot write the attribute");
}

void Object::set_text_attribute(std::string_view name, const std::vector<std::string>& values) {
  std::vector<const char*> pointers;
  for (const auto& value : values) pointers.push_back(value.c_str());
  write_attribute(name, text_type().get(), {values.size()}, false, pointers.data());
}

void Object::set_attribute(std::string_view name, std::string_view value) {
  const std::string text(value);
  const char* pointer = text.c_str();
  write_attribute(name, text_type().get(), {}, true, &pointer);
}

void Object::set_fixed_text_attribute(std::string_view name, std::string_view value) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), value.size());
  write_attribute(name, type.get(), {}, true, value.data());
}

template <class T>
void Object::set_attribute(std::string_view name, std::span<const T> values, bool scalar) {
  write_attribute(name, native(type_of<T>()), {values.size()}, scalar, values.data());
}

void Object::set_reference_attribute(std::string_view name, std::string_view target) {
  hobj_ref_t reference;
  checked<WriteError>(H5Rcreate(&reference, id(), std::string(target).c_str(), H5R_OBJECT, -1), place(target),
                      "cannot refer to it");
  write_attribute(name, H5T_STD_REF_OBJ, {}, true, &reference);
}

Shape Dataset::shape() const { return shape_of_space(Handle(H5Dget_space(id()), H5Sclose).get()); }

Type Dataset::type() const { return type_of_id(Handle(H5Dget_type(id()), H5Tclose).get()); }

bool Dataset::is_stored() const {
  const Handle type(H5Dget_type(id()), H5Tclose);
  std::uint64_t bytes = 0;
  if (__builtin_mul_overflow(element_count(shape()), H5Tget_size(type.get()), &bytes)) return false;
  const Handle properties(H5Dget_create_plist(id()), H5Pclose);
  // Deflate shrinks by a factor of at most 1032, so nothing honest is larger than that.
  const std::uint64_t factor = H5Pget_nfilters(properties.get()) > 0 ? 1032 : 1;
  return bytes / factor <= std::min<std::uint64_t>(H5Dget_storage_size(id()), size_of_file(id()));
}

void Dataset::transfer(bool writing, Id memory_type, std::uint64_t first, std::uint64_t count, void* data) const {
  const Handle file_space(H5Dget_space(id()), H5Sclose);
  Shape block = shape();
  Handle memory_space(H5Scopy(file_space.get()), H5Sclose);
  if (!block.empty()) {
    std::vector<hsize_t> start(block.size(), 0), size(block.begin(), block.end());
    start[0] = first;
    size[0] = count;
    memory_space = Handle(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), H5Sclose);
    H5Sselect_hyperslab(file_space.get(), H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr);
  }
  if (writing)
    checked<WriteError>(H5Dwrite(id(), memory_type, memory_space.get(), file_space.get(), H5P_DEFAULT, data), place(""),
                        "cannot write");
  else
    checked<ContentError>(H5Dread(id(), memory_type, memory_space.get(), file_space.get(), H5P_DEFAULT, data),
                          place(""), "cannot read");
}

template <class T>
std::vector<T> Dataset::read_rows(std::uint64_t first, std::uint64_t count) const {
  std::vector<T> values(element_count(shape_of_rows(first, count)));
  if (!values.empty()) transfer(false, native(type_of<T>()), first, count, values.data());
  return values;
}

std::string Dataset::read_text() const {
  const Handle file_type(H5Dget_type(id()), H5Tclose);
  if (type_of_id(file_type.get()) != Type::text || !shape().empty())
    throw ContentError(place("") + ": expected one text, found another type");
  return read_strings(file_type.get(), 1, size_of_file(id()),
                      [&](Id memory, void* buffer) { transfer(false, memory, 0, 1, buffer); })
      .front();
}

template <class T>
void Dataset::write(std::span<const T> values) {
  const Shape size = shape();
  if (values.size() != element_count(size)) throw std::logic_error(place("") + ": wrong number of values");
  if (!values.empty())
    transfer(true, native(type_of<T>()), 0, size.empty() ? 1 : size[0], const_cast<T*>(values.data()));
}

template <class T>
void Dataset::append_rows(std::uint64_t rows, std::span<const T> values) {
  Shape size = shape();
  const std::uint64_t first = size.at(0);
  resize_rows(first + rows);
  size[0] = rows;
  if (values.size() != element_count(size)) throw std::logic_error(place("") + ": wrong number of values");
  if (!values.empty()) transfer(true, native(type_of<T>()), first, rows, const_cast<T*>(values.data()));
}

void Dataset::resize_rows(std::uint64_t rows) {
  Shape size = shape();
  size.at(0) = rows;
  const std::vector<hsize_t> extent(size.begin(), size.end());
  checked<WriteError>(H5Dset_extent(id(), extent.data()), place(""), "cannot change its length");
}

#define CRUMBLE_HDF5_TYPE(T)                                                          \
  template std::vector<T> Object::attribute<T>(std::string_view) const;               \
  template void Object::set_attribute<T>(std::string_view, std::span<const T>, bool); \
  template std::vector<T> Dataset::read_rows<T>(std::uint64_t, std::uint64_t) const;  \
  template void Dataset::write<T>(std::span<const T>);                                \
  template void Dataset::append_rows<T>(std::uint64_t, std::span<const T>);
CRUMBLE_HDF5_TYPE(std::int32_t)
CRUMBLE_HDF5_TYPE(std::int64_t)
CRUMBLE_HDF5_TYPE(std::uint8_t)
CRUMBLE_HDF5_TYPE(std::uint64_t)
CRUMBLE_HDF5_TYPE(double)
#undef CRUMBLE_HDF5_TYPE

}  // namespace crumble::hdf5

#include "common/io/hdf5.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <type_traits>

namespace crumble::hdf5 {

static_assert(std::is_same_v<Id, hid_t>);

namespace {

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

// Variable-length UTF-8: MDAnalysis 2.4.2 takes a fixed-length unit for "b'nm'" and refuses it, although H5MD asks for
// fixed length.
Handle text_type() {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), H5T_VARIABLE);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  return type;
}

// The innermost message of the library's error stack, which is the one that says something.
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
  return text.empty() ? "" : " (HDF5: " + text + ")";
}

template <class Error, class Status>
Status checked(Status status, const std::string& place, std::string_view what) {
  if (status < 0) throw Error(fmt::format("{}: {}{}", place, what, reason()));
  return status;
}

// The library prints its error stack unless told otherwise, in each process once.
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

constexpr std::uint64_t attribute_limit = 1u << 20;  // bytes; HDF5 itself stores 64 KiB in an object header

}  // namespace

std::string library_version() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return fmt::format("{}.{}.{}", major, minor, release);
}

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
std::vector<T> Dataset::read() const {
  const Shape size = shape();
  return read_rows<T>(0, size.empty() ? 1 : size[0]);
}

template <class T>
std::vector<T> Dataset::read_rows(std::uint64_t first, std::uint64_t count) const {
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
  std::vector<T> values(element_count(size));
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

Kind Group::kind(std::string_view path) const {
  const std::string text(path);
  // H5Oexists_by_name wants every link on the way to exist, so walk down.
  for (std::size_t end = text.find('/', 1);; end = text.find('/', end + 1)) {
    const std::string part = text.substr(0, end);
    if (part != "/" &&
        (H5Lexists(id(), part.c_str(), H5P_DEFAULT) <= 0 || H5Oexists_by_name(id(), part.c_str(), H5P_DEFAULT) <= 0)) {
      H5Eclear2(H5E_DEFAULT);
      return Kind::missing;
    }
    if (end == std::string::npos) break;
  }
  const Handle object(H5Oopen(id(), text.c_str(), H5P_DEFAULT), H5Oclose);
  if (object.get() < 0) return Kind::missing;
  switch (H5Iget_type(object.get())) {
    case H5I_GROUP:
      return Kind::group;
    case H5I_DATASET:
      return Kind::dataset;
    default:
      return Kind::other;
  }
}

std::vector<std::string> Group::names() const {
  std::vector<std::string> names;
  checked<ContentError>(H5Literate(
                            id(), H5_INDEX_NAME, H5_ITER_INC, nullptr,
                            [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
                              static_cast<std::vector<std::string>*>(out)->emplace_back(name);
                              return 0;
                            },
                            &names),
                        place(""), "cannot list the group");
  std::sort(names.begin(), names.end());
  return names;
}

Group Group::group(std::string_view path) const {
  const std::string text(path);
  return {Handle(checked<ContentError>(H5Gopen2(id(), text.c_str(), H5P_DEFAULT), place(text), "expected a group"),
                 H5Gclose),
          file_, place(text).substr(file_.size() + 2)};
}

Dataset Group::dataset(std::string_view path) const {
  const std::string text(path);
  return {Handle(checked<ContentError>(H5Dopen2(id(), text.c_str(), H5P_DEFAULT), place(text), "expected a dataset"),
                 H5Dclose),
          file_, place(text).substr(file_.size() + 2)};
}

std::string Group::soft_link_target(std::string_view path) const {
  const std::string text(path);
  H5L_info_t info;
  if (H5Lget_info(id(), text.c_str(), &info, H5P_DEFAULT) < 0 || info.type != H5L_TYPE_SOFT) return "";
  std::vector<char> target(std::min<std::size_t>(info.u.val_size, attribute_limit) + 1, '\0');
  if (H5Lget_val(id(), text.c_str(), target.data(), target.size() - 1, H5P_DEFAULT) < 0) return "";
  return target.data();
}

Group Group::create_group(std::string_view path) {
  const std::string text(path);
  if (kind(text) == Kind::group) return group(text);
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(links.get(), 1);
  return {Handle(checked<WriteError>(H5Gcreate2(id(), text.c_str(), links.get(), H5P_DEFAULT, H5P_DEFAULT), place(text),
                                     "cannot create the group"),
                 H5Gclose),
          file_, place(text).substr(file_.size() + 2)};
}

template <class T>
Dataset Group::create_dataset(std::string_view path, const Shape& shape, std::uint64_t rows_of_chunk) {
  const std::string text(path);
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose), properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(links.get(), 1);
  H5Pset_obj_track_times(properties.get(), false);
  if (rows_of_chunk > 0) {
    std::vector<hsize_t> chunk(shape.begin(), shape.end());
    chunk.at(0) = rows_of_chunk;
    for (auto& size : chunk) size = std::max<hsize_t>(size, 1);
    H5Pset_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data());
  }
  const Handle space = make_space(shape, rows_of_chunk > 0);
  return {Handle(checked<WriteError>(H5Dcreate2(id(), text.c_str(), native(type_of<T>()), space.get(), links.get(),
                                                properties.get(), H5P_DEFAULT),
                                     place(text), "cannot create the dataset"),
                 H5Dclose),
          file_, place(text).substr(file_.size() + 2)};
}

void Group::write_text(std::string_view path, std::string_view text) {
  const std::string name(path), content(text);
  const Handle type = text_type(), space = make_space({}, false), links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(links.get(), 1);
  H5Pset_obj_track_times(properties.get(), false);
  const Handle dataset(checked<WriteError>(H5Dcreate2(id(), name.c_str(), type.get(), space.get(), links.get(),
                                                      properties.get(), H5P_DEFAULT),
                                           place(name), "cannot create the dataset"),
                       H5Dclose);
  const char* pointer = content.c_str();
  checked<WriteError>(H5Dwrite(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, &pointer), place(name),
                      "cannot write");
}

void Group::soft_link(std::string_view target, std::string_view path) {
  checked<WriteError>(
      H5Lcreate_soft(std::string(target).c_str(), id(), std::string(path).c_str(), H5P_DEFAULT, H5P_DEFAULT),
      place(path), "cannot create the link");
}

void Group::hard_link(std::string_view target, std::string_view path) {
  checked<WriteError>(
      H5Lcreate_hard(id(), std::string(target).c_str(), id(), std::string(path).c_str(), H5P_DEFAULT, H5P_DEFAULT),
      place(path), "cannot create the link");
}

void Group::unlink(std::string_view path) {
  checked<WriteError>(H5Ldelete(id(), std::string(path).c_str(), H5P_DEFAULT), place(path), "cannot remove it");
}

namespace {

Handle file_access() {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // Readable by every tool from HDF5 1.10 on, and by older ones wherever no newer feature is needed.
  H5Pset_libver_bounds(access.get(), H5F_LIBVER_EARLIEST, H5F_LIBVER_V110);
  // Closing the file closes what is still open in it, so that close() means that all is written.
  H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG);
  return access;
}

}  // namespace

File File::create(const std::filesystem::path& path) {
  silence();
  const Handle access = file_access();
  File file;
  file.file_ = path.string();
  file.handle_ = Handle(checked<OpenError>(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get()),
                                           file.file_, "cannot create the file"),
                        H5Fclose);
  return file;
}

File File::open_with(const std::filesystem::path& path, unsigned flags) {
  silence();
  File file;
  file.file_ = path.string();
  std::error_code problem;
  const auto status = std::filesystem::status(path, problem);
  if (!std::filesystem::exists(status)) throw OpenError(file.file_ + ": no such file");
  if (!std::filesystem::is_regular_file(status))
    throw OpenError(file.file_ + ": " + (std::filesystem::is_directory(status) ? "is a directory" : "is not a file"));
  if (!std::ifstream(path)) throw OpenError(file.file_ + ": " + std::strerror(errno));
  if (std::filesystem::file_size(path, problem) == 0) throw OpenError(file.file_ + ": is empty");
  if (H5Fis_hdf5(path.c_str()) == 0) throw OpenError(file.file_ + ": is not an HDF5 file");
  const Handle access = file_access();
  file.handle_ = Handle(checked<OpenError>(H5Fopen(path.c_str(), flags, access.get()), file.file_,
                                           "cannot be opened; it may be damaged, truncated or in use"),
                        H5Fclose);
  return file;
}

File File::open(const std::filesystem::path& path) { return open_with(path, H5F_ACC_RDONLY); }
File File::modify(const std::filesystem::path& path) { return open_with(path, H5F_ACC_RDWR); }

void File::flush() { checked<WriteError>(H5Fflush(id(), H5F_SCOPE_GLOBAL), file_, "cannot write to the disk"); }

void File::close() {
  if (!handle_.reset()) throw WriteError(file_ + ": cannot be closed" + reason());
}

#define CRUMBLE_HDF5_TYPE(T)                                                          \
  template std::vector<T> Object::attribute<T>(std::string_view) const;               \
  template void Object::set_attribute<T>(std::string_view, std::span<const T>, bool); \
  template std::vector<T> Dataset::read<T>() const;                                   \
  template std::vector<T> Dataset::read_rows<T>(std::uint64_t, std::uint64_t) const;  \
  template void Dataset::write<T>(std::span<const T>);                                \
  template void Dataset::append_rows<T>(std::uint64_t, std::span<const T>);           \
  template Dataset Group::create_dataset<T>(std::string_view, const Shape&, std::uint64_t);
CRUMBLE_HDF5_TYPE(std::int32_t)
CRUMBLE_HDF5_TYPE(std::int64_t)
CRUMBLE_HDF5_TYPE(std::uint8_t)
CRUMBLE_HDF5_TYPE(std::uint64_t)
CRUMBLE_HDF5_TYPE(double)
#undef CRUMBLE_HDF5_TYPE

}  // namespace crumble::hdf5

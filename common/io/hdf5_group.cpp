#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "common/io/hdf5_detail.hpp"

namespace crumble::hdf5 {

using namespace detail;

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

// Chunks of more than this are not kept in memory but read and written at once, bytes.
constexpr std::size_t chunk_cache = 1 << 16;

Handle file_access() {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // Readable by every tool from HDF5 1.10 on, and by older ones wherever no newer feature is needed.
  H5Pset_libver_bounds(access.get(), H5F_LIBVER_EARLIEST, H5F_LIBVER_V110);
  // Closing the file closes what is still open in it, so that close() means that all is written.
  H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG);
  // A megabyte of each of twenty growing arrays, as is the default, may be more than the agglomerate itself.
  H5Pset_cache(access.get(), 0, 521, chunk_cache, 0.75);
  return access;
}

}  // namespace

File File::create(const std::filesystem::path& path) {
  silence();
  const Handle access = file_access();
  File file;
  file.file_ = path.string();
  errno = 0;
  const Id id = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get());
  const bool is_full = id < 0 && (errno == ENOSPC || errno == EDQUOT || errno == EFBIG || errno == EIO);
  if (is_full) checked<WriteError>(id, file.file_, "cannot create the file");
  file.handle_ = Handle(checked<OpenError>(id, file.file_, "cannot create the file"), H5Fclose);
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

template Dataset Group::create_dataset<std::int32_t>(std::string_view, const Shape&, std::uint64_t);
template Dataset Group::create_dataset<std::int64_t>(std::string_view, const Shape&, std::uint64_t);
template Dataset Group::create_dataset<std::uint8_t>(std::string_view, const Shape&, std::uint64_t);
template Dataset Group::create_dataset<std::uint64_t>(std::string_view, const Shape&, std::uint64_t);
template Dataset Group::create_dataset<double>(std::string_view, const Shape&, std::uint64_t);

}  // namespace crumble::hdf5

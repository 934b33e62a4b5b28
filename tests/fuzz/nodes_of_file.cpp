#define H5O_info_t_vers 1
#include <hdf5.h>

#include <cstring>

#include "tests/fuzz/nodes_in_memory.hpp"

namespace crumble::hdf5::memory {

namespace {

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

}  // namespace

Nodes nodes_of_file(const std::string& file) { return Reading(file).nodes(); }

}  // namespace crumble::hdf5::memory

// What the sources of the HDF5 layer share, with the library's own header.
#pragma once

#include <fmt/format.h>

// With this HDF5 1.12 and later know under H5O_info_t what 1.10 does: a file number and an address, which H5Oget_info2
// fills.
#define H5O_info_t_vers 1
#include <hdf5.h>

#include <string>
#include <string_view>
#include <type_traits>

#include "common/io/hdf5.hpp"

namespace crumble::hdf5::detail {

static_assert(std::is_same_v<Id, hid_t>);

Id native(Type type);
Type type_of_id(Id type);
Shape shape_of_space(Id space);
Handle make_space(const Shape& shape, bool growing);

// Variable-length UTF-8: MDAnalysis 2.4.2 takes a fixed-length unit for "b'nm'" and refuses it, although H5MD asks for
// fixed length.
Handle text_type();

// The innermost message of the library's error stack, which is the one that says something; clears the stack.
std::string reason();

// The library prints its error stack unless told otherwise, in each process once.
void silence();

template <class Error, class Status>
Status checked(Status status, const std::string& place, std::string_view what) {
  if (status < 0) throw Error(fmt::format("{}: {}{}", place, what, reason()));
  return status;
}

constexpr std::uint64_t attribute_limit = 1u << 20;  // bytes; HDF5 itself stores 64 KiB in an object header

}  // namespace crumble::hdf5::detail

// What can go wrong with a data file, in the three kinds that a program treats differently.
#pragma once

#include "common/io/errors.hpp"

namespace crumble {

// The file is missing, unreadable, truncated, not HDF5, or cannot be created.
struct OpenError : InputError {
  using InputError::InputError;
};

// The file opens, but what it holds is not what it should be.
struct ContentError : FormatError {
  using FormatError::FormatError;
};

// Writing failed (disk full, quota): what was written so far is not a result.
struct WriteError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace crumble

// The numbers by which the shape of an agglomerate is told, for every verb that prints them.
#pragma once

#include <functional>
#include <vector>

#include "common/agglomerate/morphology.hpp"

namespace crumble::tool {

// Its name for programs, what it is, and where it stands.
struct Quantity {
  const char *name, *meaning;
  std::function<double(const Morphology&)> value;
  bool is_count = false;
};

const std::vector<Quantity>& quantities();

}  // namespace crumble::tool

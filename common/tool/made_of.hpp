// What the spheres of an agglomerate are made of: typed, of the file, or by default.
#pragma once

#include <string>

#include "common/contact/material.hpp"
#include "common/io/properties.hpp"

namespace crumble::tool {

struct MadeOf {
  Material material;
  Properties properties;  // all that the new file holds
  std::string text;       // each value with its source
};

// typed: by key ("material.surface_energy"); parent: of the file before, empty if there was none.
MadeOf made_of(const Properties& typed, const Properties& parent);

}  // namespace crumble::tool

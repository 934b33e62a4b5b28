// What an agglomerate is made of and what surrounds it, as it travels in the file from stage to stage.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>

#include "common/io/hdf5.hpp"

namespace crumble {

// By the key of a scene ("material.surface_energy"), in the unit of the scene, which is SI.
using Properties = std::map<std::string, double>;

struct TravellingKey {
  std::string_view key, path;    // in a scene; in the file
  std::string_view former = "";  // key of earlier versions
};
std::span<const TravellingKey> travelling_keys();

// Those of a file. Before schema version 1.1 they stand only in the resolved scene, under the keys of that time; what
// is in neither is absent.
Properties read_properties(const hdf5::File& file);

// Out of the text of a resolved scene; empty where it is none.
Properties properties_in(const std::string& resolved);

}  // namespace crumble

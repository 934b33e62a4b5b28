// Edits of an agglomerate file, one a line, for the fuzzer and for whoever reads what it found:
//
//     base STAGE                        first: which of data/samples is edited: dryer, breaker, rigidstress or import
//     size SYMBOL COUNT                 every array that has the symbol of the schema among its sizes is cut or goes on
//     number PATH INDEX VALUE           of an array, the index counted modulo its length
//     array PATH TYPE SHAPE VALUE...    in place of what is there: 3x12 and so on, 1 for a scalar "-"; values repeat
//     declare PATH TYPE SHAPE           the same, never written
//     unit PATH TEXT
//     attribute GROUP NAME TYPE VALUE...
//     text PATH TEXT
//     remove PATH
//     group PATH
//     soft TARGET PATH, hard TARGET PATH    links
//
// What makes no sense is passed over.
#pragma once

#include <filesystem>
#include <string_view>

#include "common/io/hdf5.hpp"

namespace crumble::fuzz {

// A file to be changed that holds what `sample` does: in memory or a copy on the disk, as the program is linked.
std::filesystem::path copy_of(const std::filesystem::path& sample);

// The file of these edits.
std::filesystem::path edited(std::string_view edits);

}  // namespace crumble::fuzz

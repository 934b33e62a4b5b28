// Spheres read from a text file: CSV, XYZ or extended XYZ.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/agglomerate/agglomerate.hpp"
#include "common/text/lines.hpp"

namespace crumble {

// What is wrong with the text, beginning with file and line.
using PointListError = text::TextError;

// The file cannot be read at all.
using PointListOpenError = text::UnreadableError;

struct PointList {
  std::string file;               // as messages call it
  std::vector<Vector3> position;  // in the file's unit
  std::vector<double> radius;     // in the file's unit, half of a diameter; empty if the file has none
  std::vector<int> line;          // where each sphere stands, from 1
  int frames = 1;                 // of an XYZ file with several the last is taken
};

// A table as text::Csv reads it. The first line that is not empty and not a comment (#) is the header: x, y, z and, if
// wanted, radius or diameter (also called d), in any order and case.
PointList parse_csv(std::string_view text, const std::string& file);

// Number of spheres, a comment line, then for each sphere a label and x y z. If the comment line is that of extended
// XYZ (Properties=name:type:columns:...), the columns pos and radius are found by it and others are passed over.
PointList parse_xyz(std::string_view text, const std::string& file);

// By the ending of the name: .csv, .xyz or .extxyz.
PointList read_points(const std::string& file);

}  // namespace crumble

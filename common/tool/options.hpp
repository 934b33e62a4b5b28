// What the command line of `agglomerate` asks for.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/agglomerate/import.hpp"
#include "common/io/properties.hpp"

namespace crumble::tool {

// --frame all|last|K
struct FrameChoice {
  enum class Kind { all, last, one } kind = Kind::last;
  std::size_t number = 0;  // from 0, for Kind::one
};

enum class Format { table, json, csv, cdf };

struct Answer {  // --help, --version
  std::string text;
};
struct CheckOptions {
  std::vector<std::string> files;
};
struct CompareOptions {
  std::string first, second;
};
struct InfoOptions {
  std::string file;
  Format format = Format::table;
};
struct ImportFileOptions {
  std::string input, output;
  ImportOptions how;    // but for its material
  Properties material;  // what was typed of it
};
struct ExportOptions {
  std::string input, output;
  FrameChoice frame{FrameChoice::Kind::all};
};
struct MorphologyOptions {
  std::string file;
  Format format = Format::table;
  FrameChoice frame;
};
struct ScaleOptions {
  std::string input, output;
  double radius = 0;    // m
  Properties material;  // what was typed of it
};
struct SchemaOptions {};

using Options = std::variant<Answer, CheckOptions, CompareOptions, InfoOptions, ImportFileOptions, ExportOptions,
                             MorphologyOptions, ScaleOptions, SchemaOptions>;

// Throws InputError on everything that cannot be meant.
Options parse_options(int argc, const char* const* argv);

}  // namespace crumble::tool

// The command line that all programs share: PROGRAM SCENE.toml [INPUT...] -o FILE.h5 [options].
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/io/output_file.hpp"
#include "common/io/parameters.hpp"

namespace crumble {

struct ProgramDescription {
  struct Text {
    std::string what, meaning;
  };

  std::string name;               // "dryer"
  std::string purpose;            // a sentence or two, the first lines of --help
  std::vector<Text> inputs;       // files wanted behind the scene: {"AGGLOMERATE.h5", "the agglomerate to load"}
  std::vector<Text> examples;     // {"dryer hollow.toml -o hollow.h5", "dry one granule"}
  std::string version;            // the whole answer to --version
  ParameterTable parameters;      // --seed exists if run.seed is declared
  bool keeps_checkpoint = false;  // --restart exists
  bool loads_granules = false;    // --at exists
  bool fits_scenes = false;       // --fit-to exists
};

struct CommandLine {
  std::string scene;
  std::vector<std::string> inputs;
  std::string output;                // empty only with --check; links are followed
  std::vector<Override> overrides;   // --set in the order given, then --seed
  std::string report;                // empty: none wanted
  std::vector<WrittenFile> written;  // both, as they were typed, for OwnedOutputs
  int threads = 0;                   // 0: as many as OpenMP takes by itself
  std::string fit_to;                // of what fits; empty: not asked for
  std::string at;                    // load in service; empty: not asked for
  bool check = false, quiet = false;
  bool restart = false;    // a checkpoint must be there
  bool overwrite = false;  // a result of another scene is replaced

  // What --help, --version, --print-defaults or --print-reference asked for: print it to stdout and end with 0.
  std::optional<std::string> answer;
};

// Throws InputError on everything that cannot be meant, also on an output that cannot be written where it should be or
// would overwrite an input.
CommandLine parse_command_line(const ProgramDescription& program, int argc, const char* const* argv);

// The manual's page of all parameters, in Markdown. A test of each program compares it with the page in the tree.
std::string reference_page(const ProgramDescription& program);

}  // namespace crumble

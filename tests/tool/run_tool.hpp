// Runs the program itself, as a user would.
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/io/sample_agglomerate.hpp"

namespace crumble::test {

inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

struct Ran {
  int code;
  std::string out, err;
};

// In the folder, so that the messages hold plain file names.
inline Ran run_in(const Folder& folder, const std::string& command) {
  const auto out = folder / "stdout", err = folder / "stderr";
  const int status = std::system(
      ("cd '" + (folder / "").string() + "' && " + command + " > '" + out.string() + "' 2> '" + err.string() + "'")
          .c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(out), text_of(err)};
}

inline Ran agglomerate(const Folder& folder, const std::string& arguments) {
  return run_in(folder, "'" CRUMBLE_AGGLOMERATE "' " + arguments);
}

}  // namespace crumble::test

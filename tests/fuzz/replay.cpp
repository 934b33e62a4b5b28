// HARNESS on every file of a folder, in order, and what came of it: 1 if one shows that we are wrong.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "tests/fuzz/harness.hpp"

int main(int count, char** arguments) {
  std::vector<std::filesystem::path> files;
  if (count == 2)
    for (const auto& entry : std::filesystem::directory_iterator(arguments[1])) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  bool wrong = files.empty();
  for (const auto& file : files) {
    std::stringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    std::string result;
    try {
      result = crumble::fuzz::HARNESS(text.str());
    } catch (const std::exception& error) {
      result = std::string("WRONG: ") + error.what();
      wrong = true;
    }
    std::printf("%s: %s\n", file.filename().c_str(), result.c_str());
  }
  return wrong;
}

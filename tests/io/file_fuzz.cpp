// Damaged files: the checker and the reader return or throw, whatever the bytes are.
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <new>
#include <random>
#include <sstream>

#include "common/io/agglomerate_reader.hpp"
#include "common/io/checker.hpp"
#include "common/io/in_child.hpp"
#include "tests/io/sample_agglomerate.hpp"

namespace crumble::test {
namespace {

std::string bytes_of(const std::filesystem::path& path) {
  std::stringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

// True if the file was taken for a valid one.
bool survives(const std::filesystem::path& path) {
  bool valid = false;
  try {
    valid = check_file(path).empty();
  } catch (const OpenError&) {
  }
  try {
    EXPECT_LE(AgglomerateReader(path).frame_count(), 2u);
  } catch (const InputError&) {
  } catch (const FormatError&) {
  }
  return valid;
}

TEST(DamagedFile, NeverCrashesOrHangsCheckerOrReader) {
  const Folder folder;
  write_sample(folder / "good.h5", 2);
  const std::string good = bytes_of(folder / "good.h5");
  std::mt19937_64 random(1);
  int invalid = 0;
  const int trials = 300;
  for (int trial = 0; trial < trials; ++trial) {
    std::string bad = good;
    for (auto flips = 1 + random() % 4; flips > 0; --flips) {
      auto place = random() % bad.size();
      while (bad[place] == 0) place = (place + 1) % bad.size();  // most bytes are unused space
      bad[place] = static_cast<char>(bad[place] ^ static_cast<char>(1 + random() % 255));
    }
    std::ofstream(folder / "bad.h5", std::ios::binary) << bad;
    invalid += !survives(folder / "bad.h5");
  }
  // About three in four hit something that matters (names, sizes, values); none found would mean nothing was tried.
  EXPECT_GT(invalid, trials / 2);
}

TEST(DamagedFile, ThatCrashesTheLibraryIsAnErrorAndNoCrash) {
  try {
    in_child("a.h5", []() -> std::string {
      std::raise(SIGSEGV);
      return "survived";
    });
    FAIL() << "nothing was thrown";
  } catch (const ContentError& error) {
    EXPECT_STREQ(error.what(), "a.h5: is damaged: the HDF5 library crashes on it");
  }
}

TEST(DamagedFile, ErrorsOfTheChildKeepTheirKind) {
  EXPECT_THROW(in_child("a.h5", []() -> std::string { throw OpenError("x"); }), OpenError);
  EXPECT_THROW(in_child("a.h5", []() -> std::string { throw ContentError("x"); }), ContentError);
  EXPECT_THROW(in_child("a.h5", []() -> std::string { throw std::bad_alloc(); }), ContentError);
  const std::string large(1 << 20, 'x');  // more than a pipe holds
  EXPECT_EQ(in_child("a.h5", [&] { return large; }), large);
}

}  // namespace
}  // namespace crumble::test

// A saved state as bytes, to the bit: private to the program that wrote it, on the machine that wrote it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "common/io/sha256.hpp"
#include "common/numerics/saved_fields.hpp"

namespace crumble {

using PutBytes = std::function<void(std::span<const char>)>;

void put_text(std::string_view text, const PutBytes& put);
void put_state(const SavedState& state, const PutBytes& put);

// Reads back what was put. Nothing that is read may be used before the digest has been found to be the right one; until
// then no more memory is asked for than the file is long.
class StateReader {
 public:
  // The first `bytes` of a file; all of it without. Throws ContentError if it is shorter, OpenError if it cannot be
  // read.
  explicit StateReader(const std::filesystem::path& path);
  StateReader(const std::filesystem::path& path, std::uint64_t bytes);

  std::uint64_t left() const { return left_; }
  std::string exactly(std::uint64_t bytes);
  std::string text();
  SavedState state();
  void skip_to_end();
  const Sha256& digest() const { return digest_; }  // of what was read
  Sha256 take_digest() { return std::move(digest_); }

  [[noreturn]] void damaged() const;

 private:
  void take(void* to, std::uint64_t bytes);
  std::uint64_t count(std::uint64_t width);
  template <class T>
  std::vector<T> numbers();

  std::filesystem::path path_;
  std::ifstream file_;
  std::uint64_t left_ = 0;
  Sha256 digest_;
};

}  // namespace crumble

// SHA-256 digests, 64 lower-case hexadecimal digits.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace crumble {

// Of what comes bit by bit.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(Sha256&&) noexcept;
  Sha256& operator=(Sha256&&) noexcept;

  void add(std::span<const char> bytes);
  Sha256 copy() const;
  std::string hex() const;  // of all so far; more may be added

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

std::string sha256_of_text(std::string_view text);
std::string sha256_of_file(const std::filesystem::path& path);  // throws OpenError

}  // namespace crumble

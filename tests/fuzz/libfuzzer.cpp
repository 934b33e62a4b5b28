// The harness HARNESS, changed by MUTATOR, as libFuzzer calls them.
#include <algorithm>
#include <cstdint>
#include <cstring>

#include "tests/fuzz/harness.hpp"

using namespace crumble::fuzz;

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t largest);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  HARNESS({reinterpret_cast<const char*>(data), size});
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t largest,
                                               unsigned seed) {
  Random random(seed);
  if (random() % 4 == 0) return LLVMFuzzerMutate(data, size, largest);
  const std::string text = MUTATOR(std::string(reinterpret_cast<const char*>(data), size), random);
  const std::size_t length = std::min(text.size(), largest);
  std::memcpy(data, text.data(), length);
  return length;
}

// Random numbers as a pure function of what they are for: no stream, no state.
#pragma once

#include <Random123/philox.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>

namespace crumble {

// What a number is drawn for. Numbers of different purposes are independent.
enum class Purpose : std::uint32_t {
  start_position = 1,
  brownian_force,
  brownian_torque,
  brownian_path,
  radius,
  orientation,
  brownian_path_rest,
  eigenvector
};

inline constexpr const char* rng_name = "Philox4x32-10 (Random123)";

// Four independent 32-bit words for (seed, purpose, particle, index): the same bits in any order, on any number of
// threads, with or without a restart. Source: Salmon, Moraes, Dror & Shaw 2011.
inline std::array<std::uint32_t, 4> random_words(std::uint64_t seed, Purpose purpose, std::uint32_t particle,
                                                 std::uint64_t index) {
  const r123::Philox4x32::ctr_type counter{{static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(index >> 32),
                                            particle, static_cast<std::uint32_t>(purpose)}};
  const r123::Philox4x32::key_type key{{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}};
  const auto words = r123::Philox4x32{}(counter, key);
  return {words[0], words[1], words[2], words[3]};
}

// The same words for many particles at once, out[k][p] = random_words(seed, purpose, particle[p], index)[k], in
// vector registers.
void random_words(std::uint64_t seed, Purpose purpose, std::span<const std::uint32_t> particle, std::uint64_t index,
                  const std::array<std::uint32_t*, 4>& out);

// Uniform in (0, 1), never 0 or 1, symmetric about 1/2.
inline double uniform(std::uint32_t word) { return (word + 0.5) * 0x1p-32; }

// Four independent standard normal numbers by the method of Box & Muller (1958). The tails end at 6.8.
inline std::array<double, 4> random_normals(std::uint64_t seed, Purpose purpose, std::uint32_t particle,
                                            std::uint64_t index) {
  const auto words = random_words(seed, purpose, particle, index);
  std::array<double, 4> normals;
  for (int k = 0; k < 4; k += 2) {
    const double r = std::sqrt(-2 * std::log(uniform(words[k]))), phi = 2 * std::numbers::pi * uniform(words[k + 1]);
    normals[k] = r * std::cos(phi);
    normals[k + 1] = r * std::sin(phi);
  }
  return normals;
}

}  // namespace crumble

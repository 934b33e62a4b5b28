#include "common/io/plausible.hpp"

#include <fmt/format.h>

namespace crumble {

namespace {

void require(const Scene& scene, const std::string& key, std::string (*complaint)(double)) {
  if (!scene.is_set(key)) return;
  if (const std::string wrong = complaint(scene.real(key)); !wrong.empty()) throw scene.error(key, wrong);
}

}  // namespace

std::string radius_complaint(double radius) {
  if (radius >= smallest_radius && radius <= largest_radius) return "";
  const auto meant = [&](const char* unit, double value) {
    return fmt::format(
        "no particle of a colloid has a radius of {:g} m ({:g} to {:g} m is possible); if {} were meant, "
        "write {:g}",
        radius, smallest_radius, largest_radius, unit, value);
  };
  if (radius >= 1) return meant("nanometres", 1e-9 * radius);
  if (radius > largest_radius) return meant("micrometres", 1e-6 * radius);
  return meant("metres divided by 1e9 once too often", 1e9 * radius);
}

std::string temperature_complaint(double temperature) {
  constexpr double low = 150, high = 1000, zero_celsius = 273.15;  // K
  if (temperature >= low && temperature <= high) return "";
  return fmt::format("no colloid is liquid at {:g} K ({:g} to {:g} K is possible){}", temperature, low, high,
                     temperature < low
                         ? fmt::format("; if degrees Celsius were meant, write {:g}", temperature + zero_celsius)
                         : std::string());
}

void require_radius(const Scene& scene, const std::string& key) { require(scene, key, radius_complaint); }
void require_temperature(const Scene& scene, const std::string& key) { require(scene, key, temperature_complaint); }

}  // namespace crumble

// Values that no colloid has are of another unit, as a rule: refused, with the unit that was likely meant.
#pragma once

#include <string>

#include "common/io/parameters.hpp"

namespace crumble {

// Radii of particles that are particles and stay small against a droplet, m.
inline constexpr double smallest_radius = 1e-10, largest_radius = 1e-3;

// What is wrong with the radius of a particle in m, or nothing.
std::string radius_complaint(double radius);
// What is wrong with the temperature of a liquid in K, or nothing.
std::string temperature_complaint(double temperature);

// The same for keys of a scene, those that are not set left out. Throws InputError naming file, line and key.
void require_radius(const Scene& scene, const std::string& key);
void require_temperature(const Scene& scene, const std::string& key);

}  // namespace crumble

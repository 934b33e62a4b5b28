// A small agglomerate with every field set to something that cannot be mistaken for another, and a file of it.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "common/contact/material.hpp"
#include "common/io/agglomerate_writer.hpp"
#include "tests/temporary_folder.hpp"

namespace crumble::test {

inline Particles sample_particles(std::size_t n) {
  Particles particles;
  for (std::size_t k = 0; k < n; ++k) {
    particles.radius.push_back(10e-9 * (1 + 0.01 * static_cast<double>(k)));
    particles.mass.push_back(4.4e-21 * std::pow(particles.radius[k] / 10e-9, 3));
    particles.id.push_back(static_cast<std::int64_t>(100 + k));
    particles.species.push_back(static_cast<std::int32_t>(k % 2));
  }
  return particles;
}

// A zigzag chain cut in two between particles n/3 and n/3 + 1: gaps are those of the positions, forces rise with them
// as by JKR, displacements are across the normals, all else random but reproducible.
inline Frame sample_frame(std::size_t n, std::int64_t step) {
  const auto radius = sample_particles(n).radius;
  std::mt19937_64 random(static_cast<std::uint64_t>(step));
  const auto number = [&] { return static_cast<double>(random() >> 11) * 0x1p-53 - 0.5; };
  const auto vector = [&](double scale) { return Vector3(scale * number(), scale * number(), scale * number()); };
  Frame frame;
  frame.step = step;
  frame.time = 1e-9 * static_cast<double>(step) / 3;
  for (std::size_t k = 0; k < n; ++k) {
    frame.position.push_back(Vector3(18e-9 * static_cast<double>(k), k % 2 ? 9e-9 : 0, 0) + vector(1e-10));
    frame.orientation.push_back(Quaternion(number(), number(), number(), number()).normalized());
    frame.velocity.push_back(vector(0.1));
    frame.angular_velocity.push_back(vector(1e6));
    frame.force.push_back(vector(1e-10));
    frame.torque.push_back(vector(1e-18));
  }
  for (std::size_t k = 0; k + 1 < n; ++k) {
    if (k == n / 3) continue;
    Contact c;
    c.i = static_cast<std::int32_t>(k);
    c.j = c.i + 1;
    const Vector3 line = frame.position[k + 1] - frame.position[k];
    const double a = pair_radius(radius[k], radius[k + 1]);
    c.normal = line.normalized();
    const auto across = [&](double scale) {
      const Vector3 any = vector(scale);
      return Vector3(any - any.dot(c.normal) * c.normal);
    };
    c.gap = line.norm() - radius[k] - radius[k + 1];
    c.sliding = across(1e-10);
    c.rolling = across(1e-2);
    c.twisting = 1e-2 * number();
    c.normal_force = a * std::tanh(1e6 * c.gap / std::cbrt(a));
    c.sliding_force = across(1e-9);
    c.twisting_torque = 1e-18 * number();
    c.rolling_torque = across(1e-18);
    c.at_limit = static_cast<std::uint8_t>(random() % 8);
    c.born = std::max<std::int64_t>(0, step - static_cast<std::int64_t>(k));
    frame.contacts.push_back(c);
  }
  return frame;
}

inline FileDescription sample_description(const std::string& stage = "dryer") {
  return {stage, make_provenance(stage, {stage, "a scene.toml", "-o", "out.h5"}, 7, philox), "a = 1\n",
          "a = 1\nb = \"é\"\n"};
}

inline Observables sample_observables(int frame) {
  return {{"droplet_radius", std::max(0.0, 100e-9 - 1e-9 * frame)}, {"wetted_count", frame}, {"capillary_force", 1e-9}};
}

constexpr std::size_t sample_size = 12;
constexpr int sample_frames = 3;

inline void write_sample(const std::filesystem::path& path, int frames = sample_frames) {
  AgglomerateWriter writer(path, sample_particles(sample_size), sample_description());
  for (int t = 0; t < frames; ++t) {
    writer.append(sample_frame(sample_size, 10 + 7 * t), sample_observables(t));
    for (int k = 0; k < 5; ++k) writer.sample("front_speed", "m s-1", 10 * t + k, 1e-9 * (10 * t + k), 0.5 * k);
  }
  writer.finish("drying");
}

}  // namespace crumble::test

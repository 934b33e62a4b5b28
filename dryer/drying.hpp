// What both integrators share: the physics of a scene, the state, and the bookkeeping of contacts and idle particles.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "common/agglomerate/agglomerate.hpp"
#include "common/contact/bond_law.hpp"
#include "common/numerics/neighbours.hpp"
#include "dryer/droplet.hpp"

namespace crumble {

// The equations that a scene asks for, as numbers (SI).
struct DryingModel {
  Droplet droplet;
  double viscosity = 1e-3;  // mu, Pa s
  Material material;
  ContactChoice contact;
};

// The bond law of any pair. Equal spheres share one; unequal pairs get theirs when they first meet.
class BondLaws {
 public:
  BondLaws(const ContactChoice& choice, const Material& material, const std::vector<double>& radius);
  const BondLaw& operator()(std::int32_t i, std::int32_t j) const;

 private:
  ContactChoice choice_;
  Material material_;
  const std::vector<double>& radius_;
  bool equal_;
  BondLaw shared_;
  mutable std::unordered_map<std::uint64_t, BondLaw> pairs_;
};

// Near pairs that are not bonded, sorted; found anew when something has moved half the skin.
class OpenPairs {
 public:
  explicit OpenPairs(double skin) : skin_(skin) {}
  void update(const std::vector<Vector3>& position, const std::vector<double>& radius,
              const std::vector<Contact>& bonds);
  void open(Pair pair);
  void close(Pair pair);
  const std::vector<Pair>& pairs() const { return pairs_; }
  double skin() const { return skin_; }
  std::int64_t searches() const { return searches_; }

 private:
  double skin_;
  NeighbourSearch search_;
  std::vector<Pair> pairs_;
  std::vector<Vector3> reference_;
  std::int64_t searches_ = 0;
};

// Without Brownian motion a particle rests until the front reaches it or another particle is bonded to it. Such
// particles are not integrated: their equation of motion has no force in it.
class Activity {
 public:
  Activity(const Particles& particles, const Frame& frame);
  // Wakes what the front at R touches; true if anything woke.
  bool front_at(double R);
  bool wake(std::int32_t particle);
  bool is_active(std::int32_t particle) const { return active_[particle] != 0; }
  const std::vector<std::int32_t>& active() const { return list_; }  // ascending
  // The front radius at which the next idle particle is touched; 0 if none is left.
  double next_front() const;

 private:
  std::vector<char> active_;
  std::vector<std::int32_t> list_;
  std::vector<std::pair<double, std::int32_t>> waiting_;  // (r + a, particle), ascending
};

}  // namespace crumble

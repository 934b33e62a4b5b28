// Which particles have to be integrated.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "common/agglomerate/agglomerate.hpp"
#include "common/numerics/saved_fields.hpp"

namespace crumble::dryer {

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
  void fields(SavedFields& f);                                       // who is awake

 private:
  std::vector<char> active_;
  std::vector<std::int32_t> list_;
  std::vector<std::pair<double, std::int32_t>> waiting_;  // (r + a, particle), ascending
};

}  // namespace crumble::dryer

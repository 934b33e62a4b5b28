// The agglomerate as the run begins: at the scene's size, with closed contacts.
#pragma once

#include "breaker/scene.hpp"
#include "common/agglomerate/closing.hpp"

namespace crumble {

struct Start {
  Agglomerate agglomerate;  // at rest, time 0
  double scale = 1;         // new over old radius
  bool closed = false;
  std::size_t lost = 0, made = 0;             // contacts, by the closing
  double residual_rms = 0, residual_max = 0;  // tension in the contacts, N
  double rms_use = 0, max_use = 0;            // the same over the pull-off force of each pair
};

// Throws InputError where a listed contact is open by more than scene.largest_gap radii, naming the pair, and where the
// agglomerate is in several pieces unless the scene takes the largest; std::runtime_error if closing does not converge.
Start make_start(Agglomerate agglomerate, const std::string& name, const BreakerScene& scene);

}  // namespace crumble

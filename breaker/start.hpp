// The agglomerate as the run begins: at the scene's size, with closed contacts.
#pragma once

#include "breaker/scene.hpp"
#include "common/agglomerate/rescaled.hpp"

namespace crumble::breaker {

struct Start {
  Agglomerate agglomerate;  // at rest, time 0
  double scale = 1;         // new over old radius
  bool closed = false;
  std::size_t lost = 0, made = 0;  // contacts, by the closing
  SelfStress self_stress;
  double rigid_strength = 0;  // flow stress at which it would break if it were rigid, Pa; 0 where nothing flows
};

// Throws InputError where a listed contact is open by more than scene.largest_gap radii, naming the pair, and where the
// agglomerate is in several pieces unless the scene takes the largest; std::runtime_error if closing does not converge.
Start make_start(Agglomerate agglomerate, const std::string& name, const BreakerScene& scene);

}  // namespace crumble::breaker

// An agglomerate brought to another particle size and set at rest with closed contacts: how every stage begins.
#pragma once

#include <optional>
#include <string>

#include "common/agglomerate/closing.hpp"

namespace crumble {

// A listed contact whose surfaces are farther apart, in pair radii, is refused unless a scene says otherwise: such a
// list is wrong, and closing would tear the agglomerate about.
inline constexpr double largest_listed_gap = 0.2;

// What is wrong with the list, naming the pair; nothing if no contact is open by more than `largest` pair radii.
std::optional<std::string> open_contact(const Agglomerate& agglomerate, double largest);

// Normal forces of the contacts where the particles are, without a flow.
struct SelfStress {
  double rms = 0, max = 0;          // absolute, N
  double rms_use = 0, max_use = 0;  // the same over the pull-off force of each pair
};
SelfStress self_stress(const Agglomerate& agglomerate, const Material& material);

struct Rescaled {
  Agglomerate agglomerate;          // at rest at step 0; contacts closed, without histories, as born there
  double scale = 1;                 // new over old radius
  std::vector<NearPair> lost;       // listed contacts that could not be kept
  std::size_t made = 0;             // pairs that came to overlap: contacts, too
  double largest_move = 0;          // of a particle by closing, m
  double largest_tension = 0;       // left, in pull-off forces; 0 if there is none
  double largest_compression = 0;   // the same, positive
  double gap_rms = 0, gap_max = 0;  // |gap - equilibrium gap|, m
  SelfStress self_stress;
};

// Scales to the mean radius `radius` (without it the size stays) and closes all contacts for the material. Throws
// std::runtime_error if closing does not converge.
Rescaled rescaled(Agglomerate agglomerate, std::optional<double> radius, const Material& material);

}  // namespace crumble

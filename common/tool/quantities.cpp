#include "common/tool/quantities.hpp"

namespace crumble::tool {

const std::vector<Quantity>& quantities() {
  constexpr double nm = 1e9;
  using M = Morphology;
  static const std::vector<Quantity> all{
      {"d_c_nm", "diameter, nm", [](const M& m) { return nm * m.extent.diameter(); }},
      {"h_c_nm", "crust thickness, nm", [](const M& m) { return nm * m.extent.crust_thickness(); }},
      {"h_c_over_d_c", "crust thickness over diameter (0.5: compact)",
       [](const M& m) { return m.extent.relative_crust(); }},
      {"radius_of_gyration_nm", "radius of gyration, nm", [](const M& m) { return nm * m.radius_of_gyration; }},
      {"semi_axis_1_nm", "semi-axes of the ellipsoid of equal inertia, nm",
       [](const M& m) { return nm * m.semi_axes[0]; }},
      {"semi_axis_2_nm", "", [](const M& m) { return nm * m.semi_axes[1]; }},
      {"semi_axis_3_nm", "", [](const M& m) { return nm * m.semi_axes[2]; }},
      {"porosity", "void fraction within the diameter", [](const M& m) { return m.porosity; }},
      {"contacts", "bonded pairs", [](const M& m) { return static_cast<double>(m.contacts); }, true},
      {"coordination", "contacts of a particle, mean", [](const M& m) { return m.coordination; }},
      {"touching", "pairs with a gap below 0.02 radii", [](const M& m) { return static_cast<double>(m.touching); },
       true},
      {"coordination_touching", "such neighbours of a particle, mean",
       [](const M& m) { return m.coordination_touching; }},
      {"fragments", "pieces that no contact connects", [](const M& m) { return static_cast<double>(m.fragments); },
       true},
      {"largest_fragment", "particles in the largest",
       [](const M& m) { return static_cast<double>(m.largest_fragment); }, true},
  };
  return all;
}

}  // namespace crumble::tool

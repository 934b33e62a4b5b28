// Export for OVITO: extended XYZ for the particles, a LAMMPS "dump local" file for the bonds.
#pragma once

#include <iosfwd>

#include "common/agglomerate/agglomerate.hpp"

namespace crumble {

// One frame of extended XYZ. Lengths in nm, velocities in m/s, time in s. Columns, by the names that OVITO knows:
// id, pos, radius, velo and orientation (scalar last, as OVITO has it) where known, cluster (the fragment, 0 =
// largest), n_neighb (contacts of the particle). The cell is the tight box around the spheres, open on all sides.
void write_extended_xyz(std::ostream& out, const Particles& particles, const Frame& frame);

// The contacts of one frame as bonds between ids, for OVITO's "Load trajectory" modifier. Columns batom1 batom2 btype
// (1) dist (nm) gap_nm tension_N sliding_force_N twisting_torque_Nm rolling_torque_Nm (magnitudes but for the signed
// gap, tension and twist).
void write_bonds(std::ostream& out, const Particles& particles, const Frame& frame);

}  // namespace crumble

// What all integrators share: the state, who is active, and the making and losing of contacts.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "common/agglomerate/agglomerate.hpp"
#include "common/agglomerate/open_pairs.hpp"
#include "common/contact/bond_laws.hpp"
#include "common/numerics/saved_fields.hpp"
#include "dryer/activity.hpp"
#include "dryer/front.hpp"
#include "dryer/model.hpp"

namespace crumble::dryer {

struct IntegratorStatistics {
  std::int64_t steps = 0, rejected = 0, newton_iterations = 0;
  std::int64_t particle_steps =
      0;  // sum over the steps of the active particles; with Brownian motion, of those in short steps
  std::int64_t contacts_made = 0, contacts_lost = 0;
  double largest_overlap = 0;  // deepest overlap of any bond at the end of a step, in the pair's radius
};

class Integrator {
 public:
  virtual ~Integrator() = default;
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;

  // One step, not beyond latest_time. Throws std::runtime_error or std::domain_error saying what failed where.
  virtual void step(double latest_time) = 0;

  const IntegratorStatistics& statistics() const { return statistics_; }
  const Front& front() const { return front_; }
  // Of the liquid as the last step saw it, mol/m^3; nothing without surface forces.
  virtual std::optional<double> ionic_strength() const { return std::nullopt; }

  // All that the next step depends on beside the state, for a restart to the same bits.
  virtual void fields(SavedFields& f);

 protected:
  // skin: how far beyond contact near pairs are listed; all with a gap below `complete` are. In the smallest radius. 0
  // if open_ is not used.
  Integrator(const DryingModel& model, Agglomerate& state, double skin, double complete = 0);

  struct Motion {
    Vector3 displacement, rotation;  // m, rad
  };
  // After the positions have moved: advances the bonds by the motion of their particles, drops what has opened beyond
  // its law's reach and bonds what touches. True if the network has changed.
  template <class MotionOf>
  bool advance_bonds(MotionOf motion_of);

  // A new bond between two particles as they stand, awake from now on; it stays where it is until the next is made.
  Contact& bond(const Pair& pair);

  double smallest_radius() const { return smallest_radius_; }

  const DryingModel& model_;
  Agglomerate& state_;
  BondLaws laws_;
  Front front_;  // each step ends with front_.follow(state_)
  OpenPairs open_;
  Activity activity_;
  IntegratorStatistics statistics_;

 private:
  void advance_bond(Contact& bond, const Motion& i, const Motion& j, bool& lost);
  bool update_network(bool lost);
  double smallest_radius_;
};

template <class MotionOf>
bool Integrator::advance_bonds(MotionOf motion_of) {
  bool lost = false;
  for (Contact& bond : state_.state.contacts) advance_bond(bond, motion_of(bond.i), motion_of(bond.j), lost);
  return update_network(lost);
}

}  // namespace crumble::dryer

// The contacts of a moving agglomerate: their loads, what they go through, and when.
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "breaker/surface_pairs.hpp"
#include "common/agglomerate/agglomerate.hpp"
#include "common/agglomerate/open_pairs.hpp"
#include "common/contact/bond_laws.hpp"
#include "common/numerics/saved_fields.hpp"

namespace crumble::breaker {

// The numbers are those of /events/kind in the agglomerate file.
enum class EventKind : std::int32_t { slip = 0, twist = 1, roll = 2, rupture = 3, made = 4, fragment_lost = 5 };

struct Event {
  double time, stress;  // s, Pa
  EventKind kind;
  std::int32_t i, j;                // the contact, or -1 -1
  std::vector<std::int64_t> sizes;  // fragment lost: all fragments, descending
};

class ContactNetwork {
 public:
  // Pairs that overlap and are not bonded become contacts.
  ContactNetwork(const ContactChoice& choice, const Material& material, const std::vector<double>& radius, Frame& frame,
                 const std::optional<SurfaceForces>& surface_forces = std::nullopt);

  // Loads of contacts and surface forces on the spheres, (F_i, T_i/length), N.
  void add_loads(double length, Eigen::VectorXd& loads) const;

  // After the positions of the frame have moved by q = (dx_i, length dtheta_i): the histories follow, contacts beyond
  // their reach are lost, pairs that touch are made. True if a contact was lost or made. Time and stress go into the
  // events.
  bool advance(const Eigen::VectorXd& q, double length, double stress);

  // Fraction of the increments q at which the first open pair comes to touch, 1 if none overlaps by more than
  // `precision` (in the pair's radius) at the end.
  double touch_fraction(const Eigen::VectorXd& q, double precision) const;
  // Whether any contact is beyond its reach after the increments.
  bool ruptures(const Eigen::VectorXd& q) const;

  const BondLaws& laws() const { return laws_; }
  // Forces between near surfaces, or nothing.
  const SurfacePairs* surface_pairs() const { return surface_pairs_ ? &*surface_pairs_ : nullptr; }

  // What has happened since the last call. A contact that reaches a limit is told once for each kind of limit.
  std::vector<Event> take_events();

  void fields(SavedFields& f);

 private:
  const std::vector<double>& radius_;
  Frame& frame_;
  BondLaws laws_;
  OpenPairs open_;
  std::optional<SurfacePairs> surface_pairs_;
  std::map<Pair, std::uint8_t> told_;
  std::vector<Event> events_;

  void tell_limits(const Contact& bond, double stress);
  bool make_contacts(double stress);
};

// Largest tension of all contacts, N (0 if none is in tension), and how many are at a limit.
struct NetworkState {
  double max_tension = 0, max_use = 0;  // use: tension over the pull-off force of the pair
  std::int64_t slipping = 0, twisting = 0, rolling = 0;
};
NetworkState network_state(const std::vector<Contact>& contacts, const BondLaws& laws);

}  // namespace crumble::breaker

// Bonds in structure-of-arrays form: the law of many bonds at once, for the integrators that take very many short
// steps.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "common/agglomerate/agglomerate.hpp"
#include "common/agglomerate/bond.hpp"
#include "common/contact/bond_laws.hpp"
#include "common/numerics/neighbours.hpp"
#include "dryer/six_vector.hpp"

namespace crumble::dryer {

// Positions and rotations of a set of particles. Index: place in the set. Positions need all digits, since gaps
// are differences of them; everything else is a small number of its own.
struct MotionBlock {
  std::vector<Position> position;  // m
  std::vector<SixVector> moved;    // since the bonds were last advanced, m and rad; of it, bonds read the rotation

  void resize(std::size_t count);
};

// The same law as advance(Contact&, ...) of common/agglomerate/bond.hpp, which is its reference: histories carried with
// the co-rotating frame, increased at the mid normal, capped. Only the normal law of JKR. Rotations of one step must be
// small (their cubes are neglected). Single precision: loads are good to 2e-4 of the pull-off force (test).
class BondBlock {
 public:
  std::size_t size() const { return count_; }
  // places: of the motion block; expected: number of bonds to come, for which room is made.
  void clear(std::size_t places, std::size_t expected = 0);
  // i, j: places of the two spheres in the motion block; lost_gap: beyond it the bond is lost, m.
  void add(const Contact& bond, std::int32_t i, std::int32_t j, const BondLaw& law, double a_i, double a_j,
           double lost_gap);
  void remove(std::size_t bond);  // the last one takes its place
  // All bonds as they are, with their loads, sorted; particle: that of a place.
  template <class Index>
  void hand_back(const std::vector<Index>& particle, const BondLaws& laws, std::vector<Contact>& contacts) const;
  // Frees what hand_back() does not need. Only clear() may follow it then.
  void forget_loads();

  // Moves all bonds to the positions of the block and finds their loads. Bonds that are beyond their reach pull no more
  // and are listed in lost(), ascending.
  void advance(const MotionBlock& motion);
  // Force and torque of the bonds on a place, N and N m.
  Six load_on(std::size_t place) const;

  // For stability. The stiffness is that of the last find_stiffness(), of all bonds or of the last ones.
  void find_stiffness(std::size_t from = 0);
  // Loads of the bonds as linear springs, without history, for small ways of the places; in the place of those of
  // advance().
  void respond(const std::vector<SixVector>& ways);
  // By how much the bonds of a place have become stiffer since remember_stiffness(), sums over them of
  //   2 k_n nn + 3.5 k_s (I - nn), 3.5 k_s (I - nn) and 2 max(k_r, k_t),   N/m, N/m and N m,
  // with the increase of k_n, the slope of the normal force, and of the others only where the bond is new.
  struct Stiffness {
    Eigen::Matrix3f displacing = Eigen::Matrix3f::Zero(), across = Eigen::Matrix3f::Zero();
    float turning = 0;
  };
  void remember_stiffness();
  Stiffness stiffening_on(std::size_t place) const;
  const std::vector<std::int32_t>& lost() const { return lost_; }
  double deepest_overlap() const { return deepest_; }  // of all steps since clear(), in the pair's radius

  std::int32_t first(std::size_t bond) const { return i_[bond]; }
  std::int32_t second(std::size_t bond) const { return j_[bond]; }

 private:
  // An end of a bond: register, side (0: i, 1: j) and place in one number; 0 for none.
  static std::int32_t end_of(std::size_t bond, std::size_t side) {
    return static_cast<std::int32_t>((bond / lanes + 1) * (2 * lanes) + side * lanes + place_of_lane(bond % lanes));
  }
  // What depends on the pair's radii and the material alone. most: displacement at which a spring yields.
  enum Constant : std::size_t {
    radius_i,
    radius_j,
    sum_of_radii,
    inverse_reach,
    inverse_length,
    inverse_radius,
    pull_off,
    k_s,
    k_t,
    k_r,
    most_sliding,
    most_twisting,
    most_rolling,
    constant_count
  };

  using Triple = std::array<AlignedVector<float>, 3>;  // a vector a bond, one array a component
  struct Extremes {
    Lane holding = 1, deepest = 0;
  };
  void store(std::size_t bond, Contact& contact) const;
  void move(std::size_t first, const MotionBlock& motion, Extremes& extremes);
  void write_loads(std::size_t first, const LaneVector& force, const LaneVector& on_i, const LaneVector& on_j);
  void move_as_springs(std::size_t first, const std::vector<SixVector>& ways);
  Lane constant(Constant which, std::size_t first) const {
    return Lane::load(&constants_[which][uniform_ ? 0 : first]);
  }
  Lane slope(std::size_t first) const;
  void make_room_for_loads();
  void link(std::int32_t place, std::int32_t end);
  void unlink(std::int32_t place, std::int32_t end);

  std::size_t count_ = 0;
  std::vector<std::int32_t> i_, j_, lost_;
  std::vector<std::int64_t> born_;
  Triple apart_, normal_, sliding_, rolling_;  // apart: from i to j, m
  AlignedVector<float> twisting_, gap_, lost_gap_;
  std::array<AlignedVector<float>, constant_count> constants_;  // if uniform, of one register of bonds
  bool uniform_ = true;                                         // all bonds have the same constants
  AlignedVector<SixVector> loads_;   // of bonds on places; index: end, as many zeros first as a register has ends
  AlignedVector<float> holds_;       // 1; 0 if the bond is beyond its reach
  AlignedVector<float> slope_;       // of the normal force, N/m
  AlignedVector<float> remembered_;  // slope; less than 0 where the bond is new
  float deepest_ = 0;

  // The ends of bonds at each place: capacity_ entries a place, of which degree_ are in use. The next ones up to a
  // multiple of four are none, so that loops over them are guessed right more often.
  std::size_t capacity_ = 8;
  std::vector<std::int32_t> links_;
  std::vector<std::int32_t> degree_;

  template <class Visit>
  void each_array(Visit visit);
};

// In the order of its links: the same bits, however many threads ask.
inline Six BondBlock::load_on(std::size_t place) const {
  Six sum;
  const std::int32_t* links = links_.data() + place * capacity_;
  for (std::int32_t k = 0; k < degree_[place]; k += 4)
    for (std::int32_t l = k; l < k + 4; ++l) sum += load(loads_[static_cast<std::size_t>(links[l])]);
  return sum;
}

template <class Index>
void BondBlock::hand_back(const std::vector<Index>& particle, const BondLaws& laws,
                          std::vector<Contact>& contacts) const {
  contacts.resize(count_);
  for (std::size_t b = 0; b < count_; ++b) {
    Contact& bond = contacts[b];
    bond.i = static_cast<std::int32_t>(particle[i_[b]]);
    bond.j = static_cast<std::int32_t>(particle[j_[b]]);
    store(b, bond);
    evaluate_loads(bond, laws(bond.i, bond.j));
  }
  std::sort(contacts.begin(), contacts.end(), [](const Contact& a, const Contact& b) {
    return Pair{a.i, a.j} < Pair{b.i, b.j};
  });
}

}  // namespace crumble::dryer

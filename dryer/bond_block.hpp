// Bonds in structure-of-arrays form: the law of many bonds at once, for the integrator that takes very many short
// steps.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/agglomerate/agglomerate.hpp"
#include "common/contact/bond_law.hpp"

namespace crumble {

// Arrays of a block are filled up to whole vector registers.
inline constexpr std::size_t lanes = 8;
constexpr std::size_t padded(std::size_t count) { return (count + lanes - 1) / lanes * lanes; }

// A vector a particle or bond, one array a component.
using Triple = std::array<std::vector<double>, 3>;

// Positions, rotations and loads of a set of particles, one array a component. Index: place in the set.
struct MotionBlock {
  Triple position;  // m
  Triple rotation;  // rotation vector since the bonds were last advanced, rad
  Triple force;     // N
  Triple torque;    // N m

  void resize(std::size_t count);
};

// The same law as advance(Contact&, ...) of common/agglomerate/bond.hpp, which is its reference: histories carried with
// the co-rotating frame, increased at the mid normal, capped. Only the normal law of JKR. Rotations of one step must be
// small (their cubes are neglected).
class BondBlock {
 public:
  std::size_t size() const { return count_; }
  void clear();
  // i, j: places of the two spheres in the motion block; lost_gap: beyond it the bond is lost, m.
  void add(const Contact& bond, std::int32_t i, std::int32_t j, const BondLaw& law, double a_i, double a_j,
           double lost_gap);
  void remove(std::size_t bond);  // the last one takes its place
  // Gap, normal, histories and loads back into a bond.
  void store(std::size_t bond, Contact& contact) const;

  // Moves all bonds to the positions of the block, and adds their loads to force and torque. Bonds that are beyond
  // their reach get no load and are listed in lost(), ascending.
  void advance(MotionBlock& motion);
  const std::vector<std::int32_t>& lost() const { return lost_; }
  double deepest_overlap() const { return deepest_; }  // of all steps since clear(), m

  std::int32_t first(std::size_t bond) const { return i_[bond]; }
  std::int32_t second(std::size_t bond) const { return j_[bond]; }

 private:
  using Lane = Eigen::Array<double, lanes, 1>;  // one vector register of numbers
  struct Loads {
    std::array<Lane, 3> force, torque_i, torque_j;  // on j; torques on both, N and N m
  };
  void follow(const MotionBlock& motion);
  Loads move(std::size_t first);
  void collect(std::size_t first, const Loads& loads, MotionBlock& motion);

  // What depends on the pair's radii and the material alone. most: displacement at which a spring yields.
  enum Constant : std::size_t {
    radius_i,
    radius_j,
    inverse_reach,
    inverse_length,
    pull_off,
    k_s,
    k_t,
    k_r,
    most_sliding,
    most_twisting,
    most_rolling,
    constant_count
  };

  std::size_t count_ = 0;
  std::vector<std::int32_t> i_, j_, lost_;
  std::vector<std::int64_t> born_;
  Triple apart_, turn_i_, turn_j_;  // of the two ends now: x_j - x_i, m, and their rotations
  Triple normal_, sliding_, rolling_;
  std::vector<double> twisting_, gap_, lost_gap_;
  std::array<std::vector<double>, constant_count> constants_;
  bool uniform_ = true;  // all bonds have the same constants
  double deepest_ = 0;

  template <class Visit>
  void each_array(Visit visit);
};

}  // namespace crumble

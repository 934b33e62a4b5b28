// What a free rigid agglomerate bears in flows: its response, turned and combined. No factorisation in here.
//
// Everything is for a viscosity of 1 Pa s; forces are proportional to it. In straining and shear flow the shear rate
// gamma_dot = sqrt(2 E:E) is 1/s, times are strains, and tensions are those at mu gamma_dot = 1 Pa.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/hydro/flow_kind.hpp"
#include "common/hydro/turning_body.hpp"
#include "common/numerics/done_parts.hpp"
#include "common/rigid/response.hpp"

namespace crumble::rigidstress {

// Orientations that fill all of them evenly, a pure function of the arguments: from 16 on four sets, each a
// super-Fibonacci spiral turned at random as a whole. A mean over 128 errs a quarter as much as one over independent
// ones (test). Source: Alexa 2022 (spiral).
std::vector<Quaternion> even_orientations(std::uint64_t seed, int count);

// Standard error, relative to the mean, of a mean over even_orientations(): from the means of the four sets. Nothing of
// fewer than 16 values.
std::optional<double> error_of_mean(const std::vector<double>& values);

// What breaks first, and how much of its pull-off force is used up.
struct Peak {
  int contact = -1;    // -1: no contact is in tension
  double tension = 0;  // N
  double use = 0;      // tension over pull-off force
};

struct LoadedBody {
  Response response;             // at viscosity 1 Pa s
  std::vector<double> pull_off;  // of each contact, N

  Eigen::VectorXd tensions(const Vector5& strain) const { return response.tension * strain; }
  Peak peak(const Vector5& strain) const;
  TurningBody turning(double tolerance = 1e-8) const { return TurningBody(response.drift.bottomRows<3>(), tolerance); }
};

// Where starts and orbits are kept as they are done, and under which name: nowhere without.
struct Keeping {
  DoneParts* parts = nullptr;
  std::string name;

  template <class Compute, class Fields>
  auto value(std::size_t number, Compute compute, Fields fields) const {
    return parts ? parts->value(name + " " + std::to_string(number + 1), compute, fields) : compute();
  }
};

// Flows without rotation: the body turns until it rests in one of a few orientations.
struct Attractor {
  Quaternion orientation;
  Peak peak;
  double share = 0;  // of random starts that end here; orientations with the same loads count as one
};
struct StrainingResult {
  Peak worst;  // over all orientations
  Quaternion worst_orientation = Quaternion::Identity();
  std::vector<Attractor> attractors;  // largest share first; of equal shares the larger use first
  double unsettled = 0;               // share of starts that still turn after the longest strain
  double mean_settled_tension = 0;    // over all starts
  bool is_turning = true;             // false: the drift vanishes and every orientation is kept (cubic symmetry)
};
struct StrainingChoice {
  int starts = 64;
  double longest_strain = 1e4;
  std::uint64_t seed = 1;
};
StrainingResult straining(const LoadedBody& body, const Eigen::Matrix3d& gradient, const StrainingChoice& choice,
                          Keeping keeping = {});

// A path through orientations.
struct Orbit {
  std::vector<double> time;
  std::vector<Quaternion> orientation;
  std::vector<double> max_tension;  // at each instant
  Peak peak;                        // largest on the way
  std::size_t peak_at = 0;          // its instant
  double mean_max_tension = 0;      // over time
  void fields(SavedFields& f);
};

struct ShearResult {
  Peak supremum;  // over all orientations, reached or not
  std::vector<Orbit> orbits;
  double mean_peak_tension = 0;      // of the orbits' largest tensions: what the paper averages over its set
  std::optional<double> mean_error;  // standard error of that mean over all orientations, relative
  double mean_tension = 0;           // N_max over time and orbits
  double mean_tumbling_time = 0;     // for one turn of the long axis about the vorticity; in 1/gamma_dot
  std::size_t worst_orbit = 0;
};
struct ShearChoice {
  std::vector<Quaternion> starts = even_orientations(1, 128);
  double strain = 100, sample = 0.1;
  double tolerance = 1e-8;
};
ShearResult shear(const LoadedBody& body, const ShearChoice& choice, Keeping keeping = {});

// One orbit in a flow that may change in time, sampled at `times`; gradient_at(t) in 1/s.
Orbit follow(const LoadedBody& body, const Quaternion& start, const std::vector<double>& times,
             const std::function<Eigen::Matrix3d(double)>& gradient_at, double tolerance = 1e-8);

}  // namespace crumble::rigidstress

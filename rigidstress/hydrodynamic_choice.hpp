// Which hydrodynamics, and how good its answer is: one rung as the scene says, or the cheapest that is good enough.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "common/hydro/model.hpp"
#include "common/numerics/done_parts.hpp"
#include "common/rigid/response.hpp"

namespace crumble::rigidstress {

enum class Method { automatic, fts, fts_lubrication, fts_relative_lubrication, multipole };

struct HydrodynamicChoice {
  Method method = Method::automatic;
  int order = 3;           // multipole: L
  HydroModel lubrication;  // fts-lubrication, fts-relative-lubrication: range and floor
  double accuracy = 0.01;  // automatic: relative error of the largest tension
  double memory = 4e9;     // bytes
  bool estimate = true;    // a fixed method: also what the error estimate needs
};

struct Judged {
  Response response;            // at viscosity 1 Pa s
  std::string method;           // "fts", "multipole L = 3"
  std::optional<double> error;  // relative, of the largest tension
  std::string how;              // it was estimated, or why not
  bool within_tolerance = true;
};

// A method would need more memory than allowed: says how much.
struct TooLarge : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Bytes of the dense factor of a mobility matrix of order L (1: fts).
double memory_needed(int spheres, int order);

using Say = std::function<void(const std::string&)>;

// Throws InputError where a method with lubrication meets near spheres whose radii differ by more than is known of it;
// multipoles need none, and their error is then estimated without it.
// centre: centre of mass, m. `say` hears of every rung and of warnings; `parts` keeps the rungs.
Judged judged_response(const Network& network, const Vector3& centre, const HydrodynamicChoice& choice, const Say& say,
                       DoneParts& parts);

// Change of the largest tension from one rung to the next, relative to it: the largest change among the contacts that
// bear at least half as much, each in its own worst orientation. The largest alone may stand still by chance.
double tension_change(const Eigen::MatrixXd& before, const Eigen::MatrixXd& after);

}  // namespace crumble::rigidstress

// What a rigidstress scene may say.
#pragma once

#include <optional>

#include "common/agglomerate/rescaled.hpp"
#include "common/flow/history_parameters.hpp"
#include "common/io/parameters.hpp"
#include "common/io/service_load.hpp"
#include "common/rigid/joint.hpp"
#include "common/surface_forces/surface_forces.hpp"
#include "rigidstress/first_exit.hpp"
#include "rigidstress/flows.hpp"
#include "rigidstress/history.hpp"
#include "rigidstress/hydrodynamic_choice.hpp"

namespace crumble::rigidstress {

const ParameterTable& stress_parameters();

enum class Pieces { refuse, largest, each };

struct StressScene {
  std::optional<double> radius;  // m
  Material material;
  std::optional<SurfaceForces> surface_forces;  // of which the pull-off force in the liquid is all that matters here
  Liquid liquid{1, 1000};                       // shear rates and the history only
  JointChoice joint;
  Pieces pieces = Pieces::refuse;
  double largest_gap = largest_listed_gap;  // in a
  HydrodynamicChoice hydrodynamics;
  bool elongation = true, shear = true, uniaxial = false, biaxial = false;
  std::optional<GradientHistory> history;
  std::optional<Tracks> tracks;  // many histories
  StrainingChoice straining;
  ShearChoice orbit;                // its starts and tolerance are those of the history, too
  double checkpoint_interval = 60;  // s of wall time
  std::uint64_t seed = 1;
};

// Reads the history file, if there is one, named as seen from the scene's folder.
StressScene stress_scene(const Scene& scene);

// Two resolved scenes with the same answer here have the same response of the same file: all sections but fluid,
// flow, output and run.
std::string response_key(const Scene& scene);

}  // namespace crumble::rigidstress

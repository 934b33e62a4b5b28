// What a rigidstress scene may say.
#pragma once

#include <optional>

#include "common/io/output_file.hpp"
#include "common/io/parameters.hpp"
#include "rigidstress/flows.hpp"
#include "rigidstress/history.hpp"
#include "rigidstress/hydrodynamic_choice.hpp"
#include "rigidstress/joint.hpp"

namespace crumble {

const ParameterTable& stress_parameters();

struct StressScene {
  std::optional<double> radius;  // m
  Material material;
  double viscosity = 1e-3;  // Pa s; the history only
  JointChoice joint;
  bool each_fragment = false;
  double largest_gap = 0.2;  // of listed contacts, in a
  HydrodynamicChoice hydrodynamics;
  bool elongation = true, shear = true, uniaxial = false, biaxial = false;
  std::optional<GradientHistory> history;
  StrainingChoice straining;
  ShearChoice orbit;  // its starts and tolerance are those of the history, too
  std::uint64_t seed = 1;
};

// Reads the history file, if there is one, named as seen from the scene's folder.
StressScene stress_scene(const Scene& scene);

// The files that the scene itself names.
std::vector<ReadFile> history_files(const Scene& scene);

// Two resolved scenes with the same answer here have the same response of the same file: particle, material,
// structure and hydrodynamics.
std::string response_key(const Scene& scene);

}  // namespace crumble

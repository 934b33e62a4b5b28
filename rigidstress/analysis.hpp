// One run of rigidstress, from an agglomerate to what is known about its loads.
#pragma once

#include "rigidstress/prepared.hpp"
#include "rigidstress/scene.hpp"

namespace crumble::rigidstress {

// One connected part in all the flows of the scene.
struct BodyResult {
  Body body;
  Vector3 centre = Vector3::Zero();  // m
  LoadedBody loaded;
  int bridges = 0;
  Peak worst;  // in planar elongation or simple shear, over all orientations
  std::optional<StrainingResult> elongation, uniaxial, biaxial;
  std::optional<ShearResult> shear;
  std::optional<HistoryResult> history;
  std::optional<FirstExits> exits;
};

struct Analysis {
  Prepared prepared;
  std::vector<BodyResult> bodies;  // fragments, largest first
  std::string method;              // hydrodynamics, as text
  std::optional<double> error;     // of the largest tension, relative; the largest among the bodies
  std::string how;
  bool restored = false;  // the response was read from the file

  // The one that breaks first; the largest if none can.
  const BodyResult& weakest() const;
};

// Factorises: the response of every part. Throws InputError for several fragments unless the scene wants each. `done`
// keeps the work of each.
Analysis analyse(Prepared prepared, const std::string& name, const StressScene& scene, const Say& say, DoneParts& done);

// Runs the flows on the responses.
void run_flows(Analysis& analysis, const StressScene& scene, DoneParts& done);

}  // namespace crumble::rigidstress

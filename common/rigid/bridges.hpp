// Bonds that alone hold two parts of a network together.
#pragma once

#include <vector>

#include "common/rigid/joint.hpp"

namespace crumble {

// A depth-first tree over a connected network and what it shows of its structure.
struct NetworkTree {
  std::vector<int> order;         // particles, parents before children; the first is the root
  std::vector<int> parent;        // of each particle; -1 for the root
  std::vector<int> parent_joint;  // the joint to it; -1 for the root
  std::vector<bool> bridge;       // of each joint: without it the network falls apart
  std::vector<int> block;         // of each particle: parts that no bridge divides, numbered from 0
  int blocks = 0;
};

// Source of the method: Tarjan 1974 (lowest depth that a subtree reaches by another way). Throws std::invalid_argument,
// with a particle that is not reached, unless the network is connected.
NetworkTree network_tree(int particles, const std::vector<Joint>& joints);

}  // namespace crumble

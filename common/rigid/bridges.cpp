#include "common/rigid/bridges.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace crumble {

NetworkTree network_tree(int particles, const std::vector<Joint>& joints) {
  std::vector<std::vector<std::pair<int, int>>> neighbours(particles);  // particle, joint
  for (int b = 0; b < static_cast<int>(joints.size()); ++b) {
    neighbours[joints[b].i].emplace_back(joints[b].j, b);
    neighbours[joints[b].j].emplace_back(joints[b].i, b);
  }
  NetworkTree tree;
  tree.parent.assign(particles, -1);
  tree.parent_joint.assign(particles, -1);
  tree.bridge.assign(joints.size(), false);
  tree.block.assign(particles, 0);

  // A stack of its own, since a chain of 1e5 particles is as many calls deep.
  std::vector<int> depth(particles, -1), lowest(particles, 0), next(particles, 0), stack{0};
  depth[0] = 0;
  tree.order.push_back(0);
  while (!stack.empty()) {
    const int at = stack.back();
    if (next[at] < static_cast<int>(neighbours[at].size())) {
      const auto [to, joint] = neighbours[at][next[at]++];
      if (joint == tree.parent_joint[at]) continue;
      if (depth[to] >= 0) {
        lowest[at] = std::min(lowest[at], depth[to]);
        continue;
      }
      tree.parent[to] = at;
      tree.parent_joint[to] = joint;
      depth[to] = lowest[to] = depth[at] + 1;
      tree.order.push_back(to);
      stack.push_back(to);
    } else {
      stack.pop_back();
      if (const int up = tree.parent[at]; up >= 0) {
        lowest[up] = std::min(lowest[up], lowest[at]);
        tree.bridge[tree.parent_joint[at]] = lowest[at] > depth[up];
      }
    }
  }
  if (static_cast<int>(tree.order.size()) < particles) {
    const auto missing = std::find(depth.begin(), depth.end(), -1) - depth.begin();
    throw std::invalid_argument("network: particle " + std::to_string(missing) +
                                " is not connected to particle 0 by any chain of contacts");
  }
  tree.blocks = 1;
  for (const int at : tree.order)
    if (tree.parent[at] >= 0)
      tree.block[at] = tree.bridge[tree.parent_joint[at]] ? tree.blocks++ : tree.block[tree.parent[at]];
  return tree;
}

}  // namespace crumble

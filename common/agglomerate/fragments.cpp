#include "common/agglomerate/fragments.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

namespace crumble {
namespace {

// Union-find with path halving; the root is always the smallest member, which is what breaks ties.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }

  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void join(std::size_t i, std::size_t j) {
    i = root(i);
    j = root(j);
    parent_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace

std::vector<std::int32_t> fragments(std::size_t particle_count, std::span<const Contact> contacts) {
  Sets sets(particle_count);
  for (const Contact& c : contacts) {
    if (c.i < 0 || c.j < 0 || static_cast<std::size_t>(std::max(c.i, c.j)) >= particle_count) {
      throw std::invalid_argument("fragments: contact " + std::to_string(c.i) + "-" + std::to_string(c.j) +
                                  " names a particle beyond the last one");
    }
    sets.join(static_cast<std::size_t>(c.i), static_cast<std::size_t>(c.j));
  }
  std::vector<std::size_t> size(particle_count, 0), roots;
  for (std::size_t i = 0; i < particle_count; ++i) {
    if (++size[sets.root(i)] == 1) roots.push_back(sets.root(i));
  }
  std::stable_sort(roots.begin(), roots.end(), [&](std::size_t p, std::size_t q) { return size[p] > size[q]; });
  std::vector<std::int32_t> rank(particle_count, -1), label(particle_count);
  for (std::size_t k = 0; k < roots.size(); ++k) rank[roots[k]] = static_cast<std::int32_t>(k);
  for (std::size_t i = 0; i < particle_count; ++i) label[i] = rank[sets.root(i)];
  return label;
}

std::vector<std::int64_t> fragment_sizes(std::span<const std::int32_t> fragment) {
  const auto last = std::max_element(fragment.begin(), fragment.end());
  std::vector<std::int64_t> size(last == fragment.end() ? 0 : static_cast<std::size_t>(*last) + 1, 0);
  for (std::int32_t label : fragment) ++size[static_cast<std::size_t>(label)];
  return size;
}

Agglomerate largest_fragment(const Agglomerate& g) {
  const auto label = fragments(g.particles.size(), g.state.contacts);
  Agglomerate kept;
  kept.state.step = g.state.step;
  kept.state.time = g.state.time;
  std::vector<std::int32_t> number(label.size(), -1);
  for (std::size_t p = 0; p < label.size(); ++p) {
    if (label[p] != 0) continue;
    number[p] = static_cast<std::int32_t>(kept.particles.size());
    kept.particles.radius.push_back(g.particles.radius[p]);
    kept.particles.mass.push_back(g.particles.mass[p]);
    if (!g.particles.id.empty()) kept.particles.id.push_back(g.particles.id[p]);
    if (!g.particles.species.empty()) kept.particles.species.push_back(g.particles.species[p]);
    kept.state.position.push_back(g.state.position[p]);
    if (!g.state.orientation.empty()) kept.state.orientation.push_back(g.state.orientation[p]);
  }
  for (Contact c : g.state.contacts) {
    if (number[c.i] < 0) continue;
    c.i = number[c.i];
    c.j = number[c.j];
    kept.state.contacts.push_back(c);
  }
  return kept;
}

}  // namespace crumble

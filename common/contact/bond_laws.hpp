// Which law holds between which two particles.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "common/contact/bond_law.hpp"

namespace crumble {

// The bond law of any pair. Equal spheres share one; unequal pairs get theirs when they first meet.
class BondLaws {
 public:
  BondLaws(const ContactChoice& choice, const Material& material, const std::vector<double>& radius);
  const BondLaw& operator()(std::int32_t i, std::int32_t j) const;

 private:
  ContactChoice choice_;
  Material material_;
  const std::vector<double>& radius_;
  bool equal_;
  BondLaw shared_;
  mutable std::unordered_map<std::uint64_t, BondLaw> pairs_;
};

}  // namespace crumble

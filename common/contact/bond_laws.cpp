#include "common/contact/bond_laws.hpp"

#include <algorithm>

namespace crumble {

BondLaws::BondLaws(const ContactChoice& choice, const Material& material, const std::vector<double>& radius)
    : choice_(choice),
      material_(material),
      radius_(radius),
      equal_(std::all_of(radius.begin(), radius.end(), [&](double a) { return a == radius.front(); })),
      shared_(choice, material, radius.front(), radius.front()) {}

const BondLaw& BondLaws::operator()(std::int32_t i, std::int32_t j) const {
  if (equal_) return shared_;
  const std::uint64_t key = static_cast<std::uint64_t>(i) << 32 | static_cast<std::uint32_t>(j);
  const auto found = pairs_.find(key);
  if (found != pairs_.end()) return found->second;
  return pairs_.emplace(key, BondLaw(choice_, material_, radius_[i], radius_[j])).first->second;
}

}  // namespace crumble

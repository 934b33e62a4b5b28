#include "common/numerics/done_parts.hpp"

namespace crumble {

SavedState DoneParts::saved_part(const std::string& name) const {
  SavedState part;
  const std::string prefix = name + ": ";
  const auto copy = [&](const auto& all, auto& some) {
    for (auto it = all.lower_bound(prefix); it != all.end() && it->first.starts_with(prefix); ++it)
      some[it->first.substr(prefix.size())] = it->second;
  };
  copy(all_.reals, part.reals);
  copy(all_.integers, part.integers);
  return part;
}

void DoneParts::keep(const std::string& name, SavedState& part) {
  for (auto& [field, numbers] : part.reals) all_.reals[name + ": " + field] = std::move(numbers);
  for (auto& [field, numbers] : part.integers) all_.integers[name + ": " + field] = std::move(numbers);
}

}  // namespace crumble

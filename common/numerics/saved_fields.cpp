#include "common/numerics/saved_fields.hpp"

#include <algorithm>

namespace crumble {

std::vector<std::string> field_names(const SavedState& state) {
  std::vector<std::string> names;
  for (const auto& [name, numbers] : state.reals) names.push_back(name);
  for (const auto& [name, numbers] : state.integers) names.push_back(name);
  std::sort(names.begin(), names.end());
  return names;
}

SavedFields::SavedFields(SavedState& state, bool loading)
    : store_(std::make_shared<Store>(Store{{}, &state, loading, {}})) {}

SavedFields::SavedFields(SavedState&& state)
    : store_(std::make_shared<Store>(Store{std::move(state), nullptr, true, {}})) {
  store_->state = &store_->owned;
}

void SavedFields::operator()(const std::string& name, Eigen::VectorXd& vector) {
  std::vector<double> list(vector.begin(), vector.end());
  (*this)(name, list);
  if (loading()) vector = Eigen::Map<const Eigen::VectorXd>(list.data(), static_cast<Eigen::Index>(list.size()));
}

SavedFields SavedFields::in(const std::string& name) const {
  SavedFields inside = *this;
  inside.prefix_ += name + ".";
  return inside;
}

void SavedFields::require_all_read() const {
  const auto require = [&](const auto& columns) {
    for (const auto& [name, numbers] : columns) {
      const auto read = store_->read.find(name);
      if (read == store_->read.end()) throw SavedFieldError("the field '" + name + "' is not known");
      if (read->second < numbers.size()) throw SavedFieldError("the field '" + name + "' has too many numbers");
    }
  };
  require(store_->state->reals);
  require(store_->state->integers);
}

}  // namespace crumble

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

void SavedFields::operator()(const std::string& name, Eigen::MatrixXd& matrix) {
  std::array<Eigen::Index, 2> size{matrix.rows(), matrix.cols()};
  (*this)(name + ".size", size);
  Eigen::VectorXd list = matrix.reshaped();
  (*this)(name, list);
  if (!loading()) return;
  if (size[0] < 0 || size[1] < 0 || size[0] * size[1] != list.size())
    throw SavedFieldError("the field '" + prefix_ + name + "' has a wrong size");
  matrix = list.reshaped(size[0], size[1]);
}

SavedFields SavedFields::in(const std::string& name) const {
  SavedFields inside = *this;
  inside.prefix_ += name + ".";
  return inside;
}

void SavedFields::part(const std::string& name, SavedState& part) {
  const std::string prefix = prefix_ + name + ".";
  const auto copy = [&](auto& all, auto& some) {
    if (!loading()) {
      for (const auto& [inside, numbers] : some) all[prefix + inside] = numbers;
      return;
    }
    some.clear();
    for (auto it = all.lower_bound(prefix); it != all.end() && it->first.starts_with(prefix); ++it) {
      some[it->first.substr(prefix.size())] = it->second;
      store_->read[it->first] = it->second.size();
    }
  };
  copy(store_->state->reals, part.reals);
  copy(store_->state->integers, part.integers);
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

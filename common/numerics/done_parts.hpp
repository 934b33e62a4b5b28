// The parts of a long computation that are done, by name: what was saved is not computed again.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "common/numerics/saved_fields.hpp"

namespace crumble {

class DoneParts {
 public:
  DoneParts() = default;
  explicit DoneParts(SavedState saved) : all_(std::move(saved)) {}

  std::string within;  // what the parts from now on belong to, before their names: "piece 2, "
  std::function<void(const std::string&)> begins = [](const std::string&) {};  // hears of what is computed
  std::function<void()> done = [] {};                                          // called when a part is kept; may throw

  // The value of a part: as it was saved, or computed now and kept. list(f, value) lists its fields.
  template <class Compute, class Fields>
  auto value(const std::string& name, Compute compute, Fields list) {
    const std::string whole = within + name;
    SavedState part = saved_part(whole);
    if (!part.integers.empty() || !part.reals.empty()) {
      decltype(compute()) value;
      SavedFields f = SavedFields::loader(std::move(part));
      list(f, value);
      f.require_all_read();
      return value;
    }
    begins(whole);
    auto value = compute();
    SavedFields f = SavedFields::saver(part);
    list(f, value);
    keep(whole, part);
    done();
    return value;
  }

  void fields(SavedFields& f) { f.part("done", all_); }

 private:
  SavedState saved_part(const std::string& name) const;
  void keep(const std::string& name, SavedState& part);

  SavedState all_;
};

}  // namespace crumble

// The exact state of a run as named fields. A class lists what it must remember once, in a function `fields`; saving,
// loading and listing all visit that list.
//
//   void Implicit::fields(SavedFields& f) {
//     Integrator::fields(f);
//     f("next_step", next_dt_);
//     f("rate", rate_);
//   }
//
// So a field that is added anywhere shifts no other, and a state that lacks one is refused by its name.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <concepts>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace crumble {

// Arrays by name, in the program's own units.
struct SavedState {
  std::map<std::string, std::vector<double>> reals;
  std::map<std::string, std::vector<std::int64_t>> integers;
};

// Names of all arrays, sorted.
std::vector<std::string> field_names(const SavedState& state);

// Says which field is missing, too short, or not known.
class SavedFieldError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

namespace saved {

template <class T>
concept Number = std::is_arithmetic_v<T> || std::is_enum_v<T>;
template <class T>
concept FixedEigen = std::derived_from<T, Eigen::MatrixBase<T>> &&(T::SizeAtCompileTime != Eigen::Dynamic);

// The numbers of a value of fixed size, in order.
template <Number T, class Visit>
void each_number(T& value, Visit visit) {
  visit(value);
}
template <FixedEigen T, class Visit>
void each_number(T& value, Visit visit) {
  for (Eigen::Index k = 0; k < value.size(); ++k) visit(value.coeffRef(k));
}
template <class Visit>
void each_number(Eigen::Quaterniond& q, Visit visit) {
  visit(q.w()), visit(q.x()), visit(q.y()), visit(q.z());
}
template <class T, std::size_t n, class Visit>
void each_number(std::array<T, n>& values, Visit visit) {
  for (T& value : values) each_number(value, visit);
}

// Whether those numbers are kept as reals or as integers.
template <class T>
inline constexpr bool is_real = !Number<T> || std::floating_point<T>;
template <class T, std::size_t n>
inline constexpr bool is_real<std::array<T, n>> = is_real<T>;

}  // namespace saved

class SavedFields {
 public:
  // A visitor that fills the state, and one that reads it.
  static SavedFields saver(SavedState& state) { return SavedFields(state, false); }
  static SavedFields loader(SavedState state) { return SavedFields(std::move(state)); }

  bool loading() const { return store_->loading; }

  // A number, flag, enum, fixed vector, quaternion, std::array or std::optional of these, or a list of them. Loading
  // throws SavedFieldError.
  template <class T>
  void operator()(const std::string& name, T& value) {
    in_column<saved::is_real<T>>(name, [&](auto& column) { number_by_number(column, value); });
  }
  template <class T>
  void operator()(const std::string& name, std::vector<T>& list) {
    size(name, list);
    in_column<saved::is_real<T>>(name, [&](auto& column) {
      for (T& value : list) number_by_number(column, value);
    });
  }
  void operator()(const std::string& name, Eigen::VectorXd& vector);
  void operator()(const std::string& name, Eigen::MatrixXd& matrix);
  template <class T>
  void operator()(const std::string& name, std::optional<T>& value) {
    std::vector<T> list;
    if (value) list.push_back(*value);
    (*this)(name, list);
    if (loading()) value = list.empty() ? std::nullopt : std::optional<T>(list.front());
  }

  // A list of objects, field by field: first its size, which loading gives it; then a column of one member each.
  template <class T>
  void size(const std::string& name, std::vector<T>& list) {
    auto count = static_cast<std::int64_t>(list.size());
    (*this)(name + ".count", count);
    if (count < 0) throw SavedFieldError("the field '" + prefix_ + name + ".count' is negative");
    if (loading()) list.resize(static_cast<std::size_t>(count));
  }
  template <class T, class M>
  void column(const std::string& name, std::vector<T>& list, M T::*member) {
    in_column<saved::is_real<M>>(name, [&](auto& column) {
      for (T& object : list) number_by_number(column, object.*member);
    });
  }
  // A short list of objects, each visited with the fields of NAME.
  template <class T, class Visit>
  void each(const std::string& name, std::vector<T>& list, Visit visit) {
    size(name, list);
    SavedFields inside = in(name);
    for (T& object : list) visit(inside, object);
  }
  // The fields of a part, called NAME.field.
  SavedFields in(const std::string& name) const;

  // A state that is there already, all of it, as part NAME: loading takes every array of that part.
  void part(const std::string& name, SavedState& state);

  // After loading: throws SavedFieldError if the state has more than what was asked for.
  void require_all_read() const;

 private:
  struct Store {
    SavedState owned;
    SavedState* state;
    bool loading;
    std::map<std::string, std::size_t> read;  // numbers, by column
  };
  SavedFields(SavedState& state, bool loading);
  explicit SavedFields(SavedState&& state);

  template <class N>
  struct Column {
    std::vector<N>& numbers;
    std::size_t* next;  // while loading
    const std::string& name;
  };
  template <bool real, class Use>
  void in_column(const std::string& name, Use use) {
    const std::string whole = prefix_ + name;
    auto& columns = [&]() -> auto& {
      if constexpr (real)
        return store_->state->reals;
      else
        return store_->state->integers;
    }
    ();
    if (loading() && !columns.contains(whole)) throw SavedFieldError("the field '" + whole + "' is missing");
    Column<std::conditional_t<real, double, std::int64_t>> column{columns[whole],
                                                                  loading() ? &store_->read[whole] : nullptr, whole};
    use(column);
  }
  template <class N, class T>
  static void number_by_number(Column<N>& column, T& value) {
    saved::each_number(value, [&](auto& number) {
      using Kind = std::remove_reference_t<decltype(number)>;
      if (!column.next) {
        column.numbers.push_back(static_cast<N>(number));
        return;
      }
      if (*column.next == column.numbers.size())
        throw SavedFieldError("the field '" + column.name + "' has too few numbers");
      number = static_cast<Kind>(column.numbers[(*column.next)++]);
    });
  }

  std::shared_ptr<Store> store_;
  std::string prefix_;
};

// Of an object with a function fields(SavedFields&), which is not changed.
template <class T>
SavedState save(T& object) {
  SavedState state;
  SavedFields f = SavedFields::saver(state);
  object.fields(f);
  return state;
}
template <class T>
void load(T& object, SavedState state) {
  SavedFields f = SavedFields::loader(std::move(state));
  object.fields(f);
  f.require_all_read();
}

}  // namespace crumble

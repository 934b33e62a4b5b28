#include "common/numerics/saved_fields.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace crumble {
namespace {

enum class Colour : std::uint8_t { red, green };

struct Row {
  double weight = 0;
  std::array<double, 3> axes{};
  std::vector<std::int64_t> sizes;
};

// Two classes of which one goes on from the other, as integrators do.
struct Base {
  std::int64_t steps = 0;
  double largest = 0;
  virtual ~Base() = default;
  virtual void fields(SavedFields& f) {
    f("steps", steps);
    f("largest", largest);
  }
};

struct Derived : Base {
  bool on = false;
  Colour colour = Colour::red;
  int history = 0;
  std::optional<double> error, unknown;
  Eigen::Quaterniond turn{1, 0, 0, 0};
  Eigen::VectorXd rate;
  std::vector<Eigen::Vector3d> position;
  std::vector<Row> rows;
  void fields(SavedFields& f) override {
    Base::fields(f);
    f("on", on);
    f("colour", colour);
    f("history", history);
    f("error", error);
    f("unknown", unknown);
    f("turn", turn);
    f("rate", rate);
    f("position", position);
    f.each("rows", rows, [](SavedFields& r, Row& row) {
      r("weight", row.weight);
      r("axes", row.axes);
      r("sizes", row.sizes);
    });
  }
};

Derived sample() {
  Derived d;
  d.steps = 1ll << 60;
  d.largest = 0.1;
  d.on = true;
  d.colour = Colour::green;
  d.history = -2;
  d.error = std::numeric_limits<double>::infinity();
  d.turn = Eigen::Quaterniond(0.1, 0.2, 0.3, 0.4);
  d.rate = Eigen::VectorXd::LinSpaced(7, 0, 1);
  d.position = {{1, 2, 3}, {4, 5, 6}};
  d.rows = {{1.5, {1, 2, 3}, {4, 5}}, {2.5, {}, {}}, {3.5, {7, 8, 9}, {6}}};
  return d;
}

TEST(SavedFields, GiveBackEveryKindOfValueToTheBit) {
  Derived before = sample(), after;
  load(after, save(before));
  EXPECT_EQ(after.steps, before.steps);
  EXPECT_EQ(after.largest, before.largest);
  EXPECT_EQ(after.on, before.on);
  EXPECT_EQ(after.colour, before.colour);
  EXPECT_EQ(after.history, before.history);
  EXPECT_EQ(after.error, before.error);
  EXPECT_FALSE(after.unknown);
  EXPECT_EQ(after.turn.coeffs(), before.turn.coeffs());
  EXPECT_EQ(after.rate, before.rate);
  EXPECT_EQ(after.position, before.position);
  ASSERT_EQ(after.rows.size(), before.rows.size());
  for (std::size_t k = 0; k < after.rows.size(); ++k) {
    EXPECT_EQ(after.rows[k].weight, before.rows[k].weight);
    EXPECT_EQ(after.rows[k].axes, before.rows[k].axes);
    EXPECT_EQ(after.rows[k].sizes, before.rows[k].sizes);
  }
}

// The same class after somebody has given its base one more number.
struct LongerBase : Base {
  double added = 5;
  void fields(SavedFields& f) override {
    f("added", added);
    Base::fields(f);
  }
};
struct OnLongerBase : LongerBase {
  double next = 0;
  void fields(SavedFields& f) override {
    LongerBase::fields(f);
    f("next", next);
  }
};

TEST(SavedFields, OfADerivedClassDoNotShiftWithAFieldAddedToItsBase) {
  OnLongerBase before, after;
  before.steps = 3;
  before.largest = 4;
  before.next = 6;
  load(after, save(before));
  EXPECT_EQ(after.steps, 3);
  EXPECT_EQ(after.largest, 4);
  EXPECT_EQ(after.added, 5);
  EXPECT_EQ(after.next, 6);
  EXPECT_EQ(field_names(save(before)), (std::vector<std::string>{"added", "largest", "next", "steps"}));
}

std::string refusal(SavedState state) {
  Derived d;
  try {
    load(d, std::move(state));
  } catch (const SavedFieldError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SavedFields, ThatAreMissingShortOrUnknownAreNamed) {
  Derived d = sample();
  const SavedState whole = save(d);
  EXPECT_EQ(refusal(whole), "accepted");
  // Every single one is needed.
  for (const std::string& name : field_names(whole)) {
    SavedState less = whole;
    less.reals.erase(name);
    less.integers.erase(name);
    EXPECT_EQ(refusal(less), "the field '" + name + "' is missing");
    SavedState shorter = whole;
    if (auto& reals = shorter.reals; reals.contains(name) && !reals[name].empty()) {
      reals[name].pop_back();
      EXPECT_EQ(refusal(shorter), "the field '" + name + "' has too few numbers");
      reals[name].push_back(0), reals[name].push_back(0);
      EXPECT_EQ(refusal(shorter), "the field '" + name + "' has too many numbers");
    }
  }
  SavedState more = whole;
  more.integers["surplus"] = {1};
  EXPECT_EQ(refusal(more), "the field 'surplus' is not known");
  SavedState negative = whole;
  negative.integers["position.count"] = {-1};
  EXPECT_EQ(refusal(negative), "the field 'position.count' is negative");
}

}  // namespace
}  // namespace crumble

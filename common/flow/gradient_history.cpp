#include "common/flow/gradient_history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>

#include "common/io/errors.hpp"
#include "common/text/csv.hpp"

namespace crumble {

namespace {

std::string unit_of(std::string_view name) {
  const auto open = name.find('['), close = name.find(']');
  if (open == std::string_view::npos || close == std::string_view::npos || close < open) return "";
  return std::string(text::trimmed(name.substr(open + 1, close - open - 1)));
}

// What a column is by its name: 0 the time, 1 to 9 the components of the gradient, row by row; -1 no such name.
// "dux/dy", "du_x/dy", "ux_y", "uxy" and, of the velocity u, v, w, "du/dy" and "uy" are all du_x/dy.
int column_named(std::string_view name) {
  std::string letters;
  for (const char c : name.substr(0, name.find('[')))
    if (const char low = static_cast<char>(std::tolower(static_cast<unsigned char>(c))); std::isalnum(low))
      letters += low;
  if (letters == "t" || letters == "time") return 0;
  std::erase(letters, 'd');
  if (letters.size() == 3 && letters[0] == 'u') letters.erase(0, 1);
  constexpr std::string_view axes = "xyz", velocities = "uvw";
  if (letters.size() != 2) return -1;
  const bool by_axis = name.find_first_of("uU") != name.npos && axes.find(letters[0]) != axes.npos;
  const auto i = by_axis ? axes.find(letters[0]) : velocities.find(letters[0]), j = axes.find(letters[1]);
  return i == axes.npos || j == axes.npos ? -1 : static_cast<int>(1 + 3 * i + j);
}

using Columns = std::array<std::size_t, 10>;  // where the time and the components stand

Columns read_header(const text::Words& names, const std::string& where) {
  if (names.size() != 10)
    throw InputError(
        fmt::format("{}: the header has {} columns, ten are needed: time [s] and nine components of the "
                    "velocity gradient [1/s]",
                    where, names.size()));
  Columns columns;
  columns.fill(names.size());
  for (std::size_t k = 0; k < 10; ++k) {
    const int column = column_named(names[k]);
    if (column < 0)
      throw InputError(
          fmt::format("{}: column {} '{}' is neither the time, t [s], nor a component of the velocity "
                      "gradient: dux/dx [1/s], dux/dy [1/s], ... duz/dz [1/s]",
                      where, k + 1, names[k]));
    const std::string unit = unit_of(names[k]);
    const bool right = column == 0 ? unit == "s" : unit == "1/s" || unit == "s-1" || unit == "s^-1";
    if (!right)
      throw InputError(fmt::format("{}: column {} '{}' must carry its unit, {}", where, k + 1, names[k],
                                   column == 0 ? "[s]" : "[1/s]"));
    std::size_t& place = columns[static_cast<std::size_t>(column)];
    if (place < names.size())
      throw InputError(fmt::format("{}: columns {} '{}' and {} '{}' are the same component", where, place + 1,
                                   names[place], k + 1, names[k]));
    place = k;
  }
  return columns;
}

struct Row {
  double time;
  Eigen::Matrix3d gradient;
};

// The gradient without its trace, which must be small.
Eigen::Matrix3d traceless(Eigen::Matrix3d gradient, const std::string& where) {
  const double trace = gradient.trace(), size = gradient.norm();
  if (!(std::abs(trace) <= 0.01 * size))
    throw InputError(
        fmt::format("{}: the trace of the velocity gradient is {:.3g} 1/s, {:.2g} of its norm: the fluid is "
                    "incompressible, it must vanish (do the names of the columns fit the numbers?)",
                    where, trace, std::abs(trace) / size));
  gradient.diagonal().array() -= trace / 3;
  return gradient;
}

Row parse_row(const text::Csv& csv, const Columns& columns) {
  double value[10];
  for (std::size_t k = 0; k < 10; ++k) value[k] = csv.number(k);
  Row row{value[columns[0]], {}};
  for (int k = 0; k < 9; ++k) row.gradient(k / 3, k % 3) = value[columns[static_cast<std::size_t>(k) + 1]];
  return row;
}

}  // namespace

double rate_of(const Eigen::Matrix3d& gradient) {
  const Eigen::Matrix3d E = 0.5 * (gradient + gradient.transpose());
  return std::sqrt(2 * E.squaredNorm());
}

GradientHistory GradientHistory::read(const std::string& file, double largest_step) try {
  return parse(text::whole_file(file), file, largest_step);
} catch (const text::UnreadableError& error) {
  throw InputError(error.what());
}

GradientHistory GradientHistory::parse(const std::string& text, const std::string& name, double largest_step) try {
  std::vector<double> time;
  std::vector<Eigen::Matrix3d> gradient;
  std::vector<int> line_of;
  text::Csv csv(text, name, "t [s], dux/dx [1/s], dux/dy [1/s], ... duz/dz [1/s]");
  const Columns columns = read_header(csv.names(), fmt::format("{}:{}", name, csv.lines().number()));
  while (csv.next()) {
    const Row row = parse_row(csv, columns);
    time.push_back(row.time);
    gradient.push_back(row.gradient);
    line_of.push_back(csv.lines().number());
  }
  return of(std::move(time), std::move(gradient), name, largest_step,
            [&](std::size_t k) { return fmt::format("{}:{}", name, line_of[k]); });
} catch (const text::TextError& error) {
  throw InputError(error.what());
}

GradientHistory GradientHistory::of(std::vector<double> time, std::vector<Eigen::Matrix3d> gradient,
                                    const std::string& name, double largest_step, const Place& place) {
  GradientHistory history;
  history.time_ = std::move(time);
  history.gradient_ = std::move(gradient);
  std::vector<double> intervals;
  for (std::size_t k = 0; k < history.time_.size(); ++k) {
    history.gradient_[k] = traceless(history.gradient_[k], place(k));
    if (k == 0) continue;
    intervals.push_back(history.time_[k] - history.time_[k - 1]);
    if (!(intervals.back() > 0))
      throw InputError(fmt::format("{}: time {:g} s does not follow {:g} s of {}: times must increase", place(k),
                                   history.time_[k], history.time_[k - 1], place(k - 1)));
  }
  if (history.time_.size() < 2) throw InputError(name + ": a history needs a header and at least two instants");

  std::vector<double> sorted = intervals;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
  const double median = sorted[sorted.size() / 2];
  for (std::size_t k = 0; k < intervals.size(); ++k) {
    const double strain = intervals[k] * std::max(rate_of(history.gradient_[k]), rate_of(history.gradient_[k + 1]));
    if (strain > largest_step)
      throw InputError(
          fmt::format("{}: in the {:g} s since {} the flow strains by {:.3g}, more than {:g}: too "
                      "coarse to interpolate (is the time in s and the gradient in 1/s?)",
                      place(k + 1), intervals[k], place(k), strain, largest_step));
    if (intervals[k] > 10 * median)
      throw InputError(fmt::format("{}: a gap in time: {:g} s since {}, where the median interval is {:g} s",
                                   place(k + 1), intervals[k], place(k), median));
  }
  return history;
}

double GradientHistory::mean_square_rate() const {
  double sum = 0;
  for (std::size_t k = 1; k < time_.size(); ++k) {
    const double before = rate_of(gradient_[k - 1]), after = rate_of(gradient_[k]);
    sum += 0.5 * (time_[k] - time_[k - 1]) * (before * before + after * after);
  }
  return sum / (time_.back() - time_.front());
}

Eigen::Matrix3d GradientHistory::operator()(double time) const {
  const auto after = std::upper_bound(time_.begin(), time_.end(), time);
  if (after == time_.begin()) return gradient_.front();
  if (after == time_.end()) return gradient_.back();
  const auto k = static_cast<std::size_t>(after - time_.begin());
  const double part = (time - time_[k - 1]) / (time_[k] - time_[k - 1]);
  return gradient_[k - 1] + part * (gradient_[k] - gradient_[k - 1]);  // exact where nothing changes
}

bool GradientHistory::is_straight(std::size_t from, std::size_t to, double tolerance, double weak_rate) const {
  double away = 0, rate = weak_rate;
  for (std::size_t k = from; k <= to; ++k) {
    const double part = (time_[k] - time_[from]) / (time_[to] - time_[from]);
    away = std::max(away, (gradient_[k] - gradient_[from] - part * (gradient_[to] - gradient_[from])).norm());
    rate = std::max(rate, rate_of(gradient_[k]));
  }
  return away <= tolerance * rate;
}

std::vector<double> GradientHistory::corners(double tolerance, double weak_rate) const {
  std::vector<double> found{time_.front()};
  const std::size_t last = time_.size() - 1;
  for (std::size_t from = 0; from < last;) {
    // Doubled while it is straight, then lengthened by ever smaller parts: of n instants n log n are looked at.
    std::size_t length = 1, more = 1;
    for (; from + length < last && is_straight(from, std::min(from + 2 * length, last), tolerance, weak_rate);
         length = std::min(2 * length, last - from))
      more = length;
    for (; more > 0; more /= 2)
      if (from + length + more <= last && is_straight(from, from + length + more, tolerance, weak_rate)) length += more;
    from += length;
    found.push_back(time_[from]);
  }
  return found;
}

double GradientHistory::largest_rate() const {
  double largest = 0;
  for (const Eigen::Matrix3d& g : gradient_) largest = std::max(largest, rate_of(g));
  return largest;
}

}  // namespace crumble

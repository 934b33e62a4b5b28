// A measured or computed velocity-gradient history, as a particle sees it on its way through a turbulent flow.
#pragma once

#include <Eigen/Dense>
#include <functional>
#include <string>
#include <vector>

namespace crumble {

double rate_of(const Eigen::Matrix3d& gradient);  // sqrt(2 E:E), 1/s

// Gradients at instants, in between linear.
class GradientHistory {
 public:
  // A CSV file: one header line of ten names in any order, each with its unit in brackets: t [s] and the nine
  // components dux/dx [1/s], dux/dy [1/s], ...; lines that begin with # are skipped. Throws InputError, naming file and
  // line, on: other names or units; a row without ten finite numbers; times that do not increase; a trace above 1 % of
  // the gradient (the rest is removed); a gap in time, that is, an interval in which the flow would strain by more than
  // `largest_step` or which is more than ten times the median interval.
  static GradientHistory read(const std::string& file, double largest_step = 1);
  static GradientHistory parse(const std::string& text, const std::string& name, double largest_step = 1);

  // The same checks of numbers from elsewhere; place(k): where instant k stands, for messages.
  using Place = std::function<std::string(std::size_t)>;
  static GradientHistory of(std::vector<double> time, std::vector<Eigen::Matrix3d> gradient, const std::string& name,
                            double largest_step, const Place& place);

  Eigen::Matrix3d operator()(double time) const;
  const Eigen::Matrix3d& at(std::size_t instant) const { return gradient_[instant]; }
  const std::vector<double>& times() const { return time_; }
  // Instants, the first and the last among them, between any two of which the history is a straight line within
  // `tolerance` of the largest rate there or, in weak flow, of `weak_rate` (1/s): steps that end at them miss nothing.
  std::vector<double> corners(double tolerance, double weak_rate) const;
  double largest_rate() const;      // largest sqrt(2 E:E), 1/s
  double mean_square_rate() const;  // 2 E:E, mean over time, 1/s^2

 private:
  bool is_straight(std::size_t from, std::size_t to, double tolerance, double weak_rate) const;

  std::vector<double> time_;               // s
  std::vector<Eigen::Matrix3d> gradient_;  // 1/s
};

}  // namespace crumble

#include "dryer/chebyshev.hpp"

#include <algorithm>
#include <cmath>

namespace crumble::dryer {

namespace {
constexpr double damping = 2;  // T_s(w0) = cosh(2) in the limit of many stages
}

int Chebyshev::stages(double dt, double rate) {
  // Stable up to (w0 + 1)/w1 = 2 s^2 tanh(y)/y, y = damping, in the limit; for few stages a little less.
  const double limit = 2 * std::tanh(damping) / damping;
  return std::max(3, static_cast<int>(std::ceil(std::sqrt(dt * rate / limit))) + 1);
}

Chebyshev::Chebyshev(int stages) {
  const int s = stages;
  const double w0 = 1 + 0.5 * damping * damping / (static_cast<double>(s) * s);
  std::vector<double> T(s + 1), slope(s + 1);
  T[0] = 1, T[1] = w0, slope[0] = 0, slope[1] = 1;
  for (int j = 2; j <= s; ++j) {
    T[j] = 2 * w0 * T[j - 1] - T[j - 2];
    slope[j] = 2 * T[j - 1] + 2 * w0 * slope[j - 1] - slope[j - 2];
  }
  const double w1 = T[s] / slope[s];
  const auto time = [&](int j) { return w1 * slope[j] / T[j]; };
  for (int j = 1; j <= s; ++j) {
    stage.push_back({j == 1 ? 0 : T[j - 2] / T[j], (j == 1 ? 1 : 2) * w1 * T[j - 1] / T[j], time(j - 1)});
    reached.push_back(time(j));
  }
}

}  // namespace crumble::dryer

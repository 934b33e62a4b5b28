#include "common/hydro/sparse_inverse.hpp"

#include <algorithm>
#include <limits>

namespace crumble {

namespace {

using Block = Eigen::Matrix<double, 11, 11>;

// (E, U, Omega) of one sphere by (S, F, T) of another: the rows of a sphere in the order that is used here.
Block pair_block(const Spheres& s, int i, int j) {
  Block b;
  if (i == j) {
    const SelfMobility self(s.radius[i]);
    Eigen::Matrix<double, 11, 1> d;
    d << Vector5::Constant(self.stresslet), Vector3::Constant(self.force), Vector3::Constant(self.torque);
    b = d.asDiagonal();
    return b;
  }
  const PairMobility m = pair_mobility(s.position[i] - s.position[j], s.radius[i], s.radius[j]);
  b << m.strain_stresslet, m.strain_force, m.motion_stresslet, m.motion_force;
  return b;
}

struct Order {
  std::vector<int> sphere;
  std::vector<double> scale;  // distance to the nearest before it
};

Order coarse_to_fine(const Spheres& s) {
  const int n = s.size();
  Order order;
  std::vector<double> distance2(static_cast<std::size_t>(n), std::numeric_limits<double>::infinity());
  int next = 0;
  for (int k = 0; k < n; ++k) {
    order.sphere.push_back(next);
    order.scale.push_back(std::sqrt(distance2[next]));
    distance2[next] = -1;
    const Vector3 x = s.position[next];
    for (int i = 0; i < n; ++i)
      if (distance2[i] >= 0) distance2[i] = std::min(distance2[i], (s.position[i] - x).squaredNorm());
    next = static_cast<int>(std::max_element(distance2.begin(), distance2.end()) - distance2.begin());
  }
  return order;
}

// Nearest of the first `before` spheres of the order, no farther than `reach`, and the sphere itself at the end.
std::vector<int> kept(const Spheres& s, const Order& order, int before, int most) {
  constexpr double reach = 4;  // in l_i; what is farther adds little
  const int self = order.sphere[before];
  const double limit = reach * order.scale[before];
  std::vector<std::pair<double, int>> near;
  for (int k = 0; k < before; ++k) {
    const double d2 = (s.position[order.sphere[k]] - s.position[self]).squaredNorm();
    if (d2 <= limit * limit) near.emplace_back(d2, order.sphere[k]);
  }
  const std::size_t count = std::min(near.size(), static_cast<std::size_t>(most));
  std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count), near.end());
  std::vector<int> result;
  for (std::size_t k = 0; k < count; ++k) result.push_back(near[k].second);
  result.push_back(self);
  return result;
}

Eigen::Matrix<float, 11, 1> rows_of(const Eigen::VectorXf& v, int n, int i) {
  Eigen::Matrix<float, 11, 1> x;
  x << v.segment<5>(5 * i), v.segment<6>(5 * n + 6 * i);
  return x;
}

}  // namespace

SparseInverse::SparseInverse(const Spheres& s, int neighbours) : columns_(static_cast<std::size_t>(s.size())) {
  const Order order = coarse_to_fine(s);
#pragma omp parallel for schedule(dynamic, 16)
  for (int k = 0; k < s.size(); ++k) {
    Columns& column = columns_[static_cast<std::size_t>(k)];
    column.sphere = kept(s, order, k, neighbours);
    const int m = static_cast<int>(column.sphere.size());
    Eigen::MatrixXd M(11 * m, 11 * m);
    for (int p = 0; p < m; ++p)
      for (int q = 0; q <= p; ++q) M.block<11, 11>(11 * p, 11 * q) = pair_block(s, column.sphere[p], column.sphere[q]);
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(M);
    Eigen::MatrixXd x = Eigen::MatrixXd::Zero(11 * m, 11);
    x.bottomRows<11>().setIdentity();
    factor.matrixU().solveInPlace(x);
    column.value = x.cast<float>();
  }
}

Eigen::VectorXd SparseInverse::apply(const Eigen::VectorXd& r) const {
  const int n = static_cast<int>(columns_.size());
  const Eigen::VectorXf r32 = r.cast<float>();
  Eigen::Matrix<float, 11, Eigen::Dynamic> y(11, n);
#pragma omp parallel for schedule(static) if (n > 1000)
  for (int k = 0; k < n; ++k) {
    const Columns& c = columns_[static_cast<std::size_t>(k)];
    Eigen::Matrix<float, 11, 1> sum = Eigen::Matrix<float, 11, 1>::Zero();
    for (std::size_t p = 0; p < c.sphere.size(); ++p)
      sum.noalias() +=
          c.value.middleRows<11>(11 * static_cast<Eigen::Index>(p)).transpose() * rows_of(r32, n, c.sphere[p]);
    y.col(k) = sum;
  }
  // Several columns meet in one row: in order, so that the sum does not depend on threads.
  Eigen::VectorXd z = Eigen::VectorXd::Zero(11 * n);
  for (int k = 0; k < n; ++k) {
    const Columns& c = columns_[static_cast<std::size_t>(k)];
    for (std::size_t p = 0; p < c.sphere.size(); ++p) {
      const Eigen::Matrix<float, 11, 1> part = c.value.middleRows<11>(11 * static_cast<Eigen::Index>(p)) * y.col(k);
      const int i = c.sphere[p];
      z.segment<5>(5 * i) += part.head<5>().cast<double>();
      z.segment<6>(5 * n + 6 * i) += part.tail<6>().cast<double>();
    }
  }
  return z;
}

}  // namespace crumble

#include "common/agglomerate/bond_increment.hpp"

#include <algorithm>
#include <cmath>

#include "common/contact/kinematics.hpp"
#include "common/contact/plastic_spring.hpp"

namespace crumble {

using Matrix3 = Eigen::Matrix3d;

BondIncrement::BondIncrement(const Contact& bond, const BondLaw& law, const BondEnds& ends, const Vector3& separation,
                             const Vector6& q_i, const Vector6& q_j)
    : law_(law), bond_(bond), scale_i_(ends.scale_i), scale_j_(ends.scale_j) {
  const Vector3 dx = q_j.head<3>() - q_i.head<3>();
  const Vector3 W_i = q_i.tail<3>() / scale_i_, W_j = q_j.tail<3>() / scale_j_;
  const double l_i = lever_arm(bond, ends.radius_i, ends.radius_j), l_j = lever_arm(bond, ends.radius_j, ends.radius_i);
  const Vector3 now = separation + dx, &n0 = bond.normal;
  distance_ = now.norm();
  n_ = now / distance_;
  gap_ = distance_ - ends.radius_i - ends.radius_j;
  const RelativeMotion seen = relative_motion(n0, dx, W_i, W_j, l_i, l_j);
  sliding_ = bond.sliding + seen.sliding;
  rolling_ = bond.rolling + seen.rolling;
  twisting_ = bond.twisting + seen.twisting;
  sliding_limit_ = law.sliding_limit(bond.normal_force);
  c_i_ = l_i / scale_i_;
  c_j_ = l_j / scale_j_;
}

Contact foreseen(const Contact& bond, const BondLaw& law, const BondEnds& ends, const Vector3& separation,
                 const Vector6& q_i, const Vector6& q_j) {
  const Vector3 dx = q_j.head<3>() - q_i.head<3>();
  const Vector3 W_i = q_i.tail<3>() / ends.scale_i, W_j = q_j.tail<3>() / ends.scale_j;
  Contact end = bond;
  carry(end, {separation + dx, dx, W_i, W_j, ends.radius_i, ends.radius_j});
  const RelativeMotion seen = relative_motion(end.normal, dx, W_i, W_j, lever_arm(end, ends.radius_i, ends.radius_j),
                                              lever_arm(end, ends.radius_j, ends.radius_i));
  end.sliding -= seen.sliding;
  end.rolling -= seen.rolling;
  end.twisting -= seen.twisting;
  end.normal_force = law.normal(std::min(end.gap, law.lost_gap())).tension;
  return end;
}

double BondIncrement::energy() const {
  return law_.normal_energy(gap_) + capped_energy(sliding_.norm(), law_.k_s, sliding_limit_) +
         capped_energy(rolling_.norm(), law_.k_r, law_.M_r_crit) +
         capped_energy(std::abs(twisting_), law_.k_t, law_.M_t_crit);
}

namespace {

Vector3 spring_force(const Vector3& xi, double stiffness, double limit) {
  const double force = stiffness * xi.norm();
  return force <= limit ? stiffness * xi : limit / force * stiffness * xi;
}

// Second derivative of capped_energy(|xi|) across the normal: k P below the limit, (F/|xi|)(P - uu) beyond.
Matrix3 spring_matrix(const Vector3& xi, const Vector3& n, double stiffness, double limit) {
  const Matrix3 P = Matrix3::Identity() - n * n.transpose();
  const double length = xi.norm();
  if (stiffness * length <= limit) return stiffness * P;
  const Vector3 u = xi / length;
  return limit / length * (P - u * u.transpose());
}

Matrix3 cross_matrix(const Vector3& n) {
  Matrix3 C;
  C << 0, -n.z(), n.y(), n.z(), 0, -n.x(), -n.y(), n.x(), 0;
  return C;
}

}  // namespace

void BondIncrement::add_gradient(Vector6& g_i, Vector6& g_j) const {
  const Vector3& n0 = bond_.normal;
  const Vector3 F_s = spring_force(sliding_, law_.k_s, sliding_limit_);
  const double tension = lost() ? 0 : law_.normal(gap_).tension;
  const bool twisted = law_.k_t * std::abs(twisting_) > law_.M_t_crit;
  const double M_t = twisted ? std::copysign(law_.M_t_crit, twisting_) : law_.k_t * twisting_;
  const Vector3 turn = spring_force(rolling_, law_.k_r, law_.M_r_crit) + M_t * n0;
  const Vector3 pull = tension * n_ + F_s, moment = F_s.cross(n0);
  g_i.head<3>() -= pull;
  g_j.head<3>() += pull;
  g_i.tail<3>() += c_i_ * moment - turn / scale_i_;
  g_j.tail<3>() += c_j_ * moment + turn / scale_j_;
}

void BondIncrement::stiffness(Matrix6& K_ii, Matrix6& K_ij, Matrix6& K_jj, Curvature curvature) const {
  const Vector3& n0 = bond_.normal;
  const auto [N, k_n] = law_.normal(gap_);
  const Matrix3 D_s = spring_matrix(sliding_, n0, law_.k_s, sliding_limit_);
  const Matrix3 D_r = spring_matrix(rolling_, n0, law_.k_r, law_.M_r_crit);
  const bool twisted = law_.k_t * std::abs(twisting_) > law_.M_t_crit;
  const double across = curvature == Curvature::full ? N : std::max(N, 0.0);
  Matrix3 K = D_s;
  if (!lost()) K += k_n * n_ * n_.transpose() + across / distance_ * (Matrix3::Identity() - n_ * n_.transpose());
  const Matrix3 C = cross_matrix(n0), DC = D_s * C, CDC = C.transpose() * DC;
  const Matrix3 bend = D_r + (twisted ? 0 : law_.k_t) * n0 * n0.transpose();
  K_ii << K, -c_i_ * DC, (-c_i_ * DC).transpose(), c_i_ * c_i_ * CDC + bend / (scale_i_ * scale_i_);
  K_jj << K, c_j_ * DC, (c_j_ * DC).transpose(), c_j_ * c_j_ * CDC + bend / (scale_j_ * scale_j_);
  K_ij << -K, -c_j_ * DC, c_i_ * DC.transpose(), c_i_ * c_j_ * CDC - bend / (scale_i_ * scale_j_);
}

}  // namespace crumble

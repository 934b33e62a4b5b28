#include "common/hydro/far_field_sum.hpp"

#include <cmath>
#include <numbers>

namespace crumble {

namespace {

constexpr int lanes = 16;

// Forces, torques and stresslet tensors (xx, xy, xz, yy, yz, zz) by component, padded with zeros.
struct Sources {
  std::vector<double> data;
  int padded;
  double* operator[](int c) { return data.data() + static_cast<std::ptrdiff_t>(c) * padded; }
  const double* operator[](int c) const { return data.data() + static_cast<std::ptrdiff_t>(c) * padded; }
};

Sources gather(const double* q, int n, int padded) {
  Sources s{std::vector<double>(static_cast<std::size_t>(12) * padded, 0.0), padded};
  const double* motion = q + 5 * n;
  for (int i = 0; i < n; ++i) {
    for (int c = 0; c < 6; ++c) s[c][i] = motion[6 * i + c];
    const Eigen::Matrix3d S = strain_tensor(Eigen::Map<const Vector5>(q + 5 * i));
    s[6][i] = S(0, 0), s[7][i] = S(0, 1), s[8][i] = S(0, 2);
    s[9][i] = S(1, 1), s[10][i] = S(1, 2), s[11][i] = S(2, 2);
  }
  return s;
}

struct Field {
  double u[3], omega[3],
      e[6];  // 8 pi times velocity, angular velocity, rate of strain (its trace is not zero: dropped)
};

// The sum of pair_mobility over all sources for one receiver. 1/r starts in float32 and is refined to float64 by one
// third-order step (error 1e-20 relative before rounding), which is twice as fast as a float64 root and division.
Field field_at(double x, double y, double z, double a2, const double* __restrict xs, const double* __restrict ys,
               const double* __restrict zs, const double* __restrict as, const Sources& q) {
  const double* __restrict Fx = q[0], * __restrict Fy = q[1], * __restrict Fz = q[2];
  const double* __restrict Tx = q[3], * __restrict Ty = q[4], * __restrict Tz = q[5];
  const double* __restrict Sxx = q[6], * __restrict Sxy = q[7], * __restrict Sxz = q[8];
  const double* __restrict Syy = q[9], * __restrict Syz = q[10], * __restrict Szz = q[11];
  double ux = 0, uy = 0, uz = 0, ox = 0, oy = 0, oz = 0, exx = 0, exy = 0, exz = 0, eyy = 0, eyz = 0, ezz = 0;
#pragma omp simd reduction(+ : ux, uy, uz, ox, oy, oz, exx, exy, exz, eyy, eyz, ezz)
  for (int j = 0; j < q.padded; ++j) {
    const double rx = x - xs[j], ry = y - ys[j], rz = z - zs[j];
    const double r2 = rx * rx + ry * ry + rz * rz;
    const double safe = r2 > 0 ? r2 : 1.0;
    const double rough = static_cast<double>(1.0f / std::sqrt(static_cast<float>(safe)));
    const double h = 1 - safe * rough * rough;
    const double root = rough * (1 + h * (0.5 + 0.375 * h));
    const double inverse = r2 > 0 ? root : 0.0;  // the sphere itself adds nothing
    const double nx = rx * inverse, ny = ry * inverse, nz = rz * inverse;
    const double i2 = inverse * inverse, i3 = i2 * inverse;
    const double A = a2 * i2, B = as[j] * i2, C = A + B;  // radii squared over 6 r^2
    const double fn = Fx[j] * nx + Fy[j] * ny + Fz[j] * nz, tn = Tx[j] * nx + Ty[j] * ny + Tz[j] * nz;
    const double sx = Sxx[j] * nx + Sxy[j] * ny + Sxz[j] * nz;
    const double sy = Sxy[j] * nx + Syy[j] * ny + Syz[j] * nz;
    const double sz = Sxz[j] * nx + Syz[j] * ny + Szz[j] * nz;
    const double sn = sx * nx + sy * ny + sz * nz;
    const double tx = Ty[j] * nz - Tz[j] * ny, ty = Tz[j] * nx - Tx[j] * nz, tz = Tx[j] * ny - Ty[j] * nx;

    const double uf = inverse + 2 * inverse * C, us = 12 * i2 * (A + 0.6 * B);
    const double un = inverse * (1 - 6 * C) * fn + (3 * i2 - 2.5 * us) * sn;
    ux += uf * Fx[j] + i2 * tx + us * sx + un * nx;
    uy += uf * Fy[j] + i2 * ty + us * sy + un * ny;
    uz += uf * Fz[j] + i2 * tz + us * sz + un * nz;

    // (i2 F + 3 i3 s) x n, and the torque's dipole
    const double gx = i2 * Fx[j] + 3 * i3 * sx, gy = i2 * Fy[j] + 3 * i3 * sy, gz = i2 * Fz[j] + 3 * i3 * sz;
    const double on = 1.5 * i3 * tn, ot = -0.5 * i3;
    ox += gy * nz - gz * ny + on * nx + ot * Tx[j];
    oy += gz * nx - gx * nz + on * ny + ot * Ty[j];
    oz += gx * ny - gy * nx + on * nz + ot * Tz[j];

    const double ef = -12 * i2 * (B + 0.6 * A), et = -3 * i3, eS = 7.2 * C * i3, es = 6 * i3 - 10 * eS;
    const double en = (17.5 * eS - 15 * i3) * sn - (3 * i2 + 2.5 * ef) * fn;
    const double kx = ef * Fx[j] + et * tx + es * sx + en * nx;
    const double ky = ef * Fy[j] + et * ty + es * sy + en * ny;
    const double kz = ef * Fz[j] + et * tz + es * sz + en * nz;
    const double e2 = 2 * eS;
    exx += kx * nx + eS * Sxx[j];
    eyy += ky * ny + eS * Syy[j];
    ezz += kz * nz + eS * Szz[j];
    exy += kx * ny + ky * nx + e2 * Sxy[j];
    exz += kx * nz + kz * nx + e2 * Sxz[j];
    eyz += ky * nz + kz * ny + e2 * Syz[j];
  }
  return {{ux, uy, uz}, {ox, oy, oz}, {exx, 0.5 * exy, 0.5 * exz, eyy, 0.5 * eyz, ezz}};
}

}  // namespace

FarFieldSum::FarFieldSum(const Spheres& s) : n_(s.size()), padded_((s.size() + lanes - 1) / lanes * lanes) {
  const auto length = static_cast<std::size_t>(padded_);
  // Padding stands at the last sphere: harmless without sources.
  x_.assign(length, s.position.back().x());
  y_.assign(length, s.position.back().y());
  z_.assign(length, s.position.back().z());
  radius2_.assign(length, 1.0);
  for (int i = 0; i < n_; ++i) {
    x_[i] = s.position[i].x(), y_[i] = s.position[i].y(), z_[i] = s.position[i].z();
    radius2_[i] = s.radius[i] * s.radius[i] / 6;
    const SelfMobility self(s.radius[i]);
    self_force_.push_back(self.force);
    self_torque_.push_back(self.torque);
    self_stresslet_.push_back(self.stresslet);
  }
}

void FarFieldSum::apply(const double* q, double* w) const {
  const Sources sources = gather(q, n_, padded_);
  constexpr double oseen = 1 / (8 * std::numbers::pi);
  const double* q_motion = q + 5 * n_;
  double* w_motion = w + 5 * n_;
#pragma omp parallel for schedule(static) if (n_ > 1000)
  for (int i = 0; i < n_; ++i) {
    const Field f =
        field_at(x_[i], y_[i], z_[i], radius2_[i], x_.data(), y_.data(), z_.data(), radius2_.data(), sources);
    Eigen::Matrix3d E;
    E << f.e[0], f.e[1], f.e[2], f.e[1], f.e[3], f.e[4], f.e[2], f.e[4], f.e[5];
    Eigen::Map<Vector5>(w + 5 * i) =
        oseen * strain_components(E) + self_stresslet_[i] * Eigen::Map<const Vector5>(q + 5 * i);
    for (int c = 0; c < 3; ++c) {
      w_motion[6 * i + c] = oseen * f.u[c] + self_force_[i] * q_motion[6 * i + c];
      w_motion[6 * i + 3 + c] = oseen * f.omega[c] + self_torque_[i] * q_motion[6 * i + 3 + c];
    }
  }
}

}  // namespace crumble

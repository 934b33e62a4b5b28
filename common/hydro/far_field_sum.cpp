#include "common/hydro/far_field_sum.hpp"

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <span>

#include "common/numerics/simd.hpp"

namespace crumble {

namespace {

// As many receivers at once as a register holds doubles.
using Lanes = Simd<double>;
constexpr int width = Lanes::size;

// A sphere as the others feel it. With a and b the squares over 6 of the radii of receiver and source, the two averages
// that are needed besides their sum are 4 a + 2.4 b and 2.4 a + 4 b.
struct Source {
  double x, y, z, b2_4, b4;
  double Fx, Fy, Fz, Tx, Ty, Tz, Sxx, Sxy, Sxz, Syy, Syz, Szz;  // S: three times the stresslet
};

struct Field {
  Lanes u[3], omega[3], e[6];  // 8 pi times velocity, angular velocity, rate of strain (its trace is not zero: dropped)
};

// Starts from half the exponent (error 3.4 %); one step of fifth order and one of third leave 2e-19 before rounding.
// A root and a division take four times as long.
Lanes inverse_root(const Lanes& x) {
  const hn::RebindToSigned<Lanes::Tag> bits;
  Lanes y = hn::BitCast(Lanes::Tag(),
                        hn::Sub(hn::Set(bits, 0x5fe6eb50c7b537a9), hn::ShiftRight<1>(hn::BitCast(bits, x.at[0]))));
  Lanes h = 1 - x * (y * y);
  y = y + y * h * (0.5 + h * (0.375 + h * (0.3125 + h * 0.2734375)));
  h = 1 - x * (y * y);
  return y + y * h * (0.5 + 0.375 * h);
}

// The sum of pair_mobility over all sources for a register of receivers. Directions are found for some sources at once
// and kept: a pair alone is a chain of a hundred dependent instructions, of many pairs one covers the waiting of
// another.
Field field_at(const Lanes& x, const Lanes& y, const Lanes& z, const Lanes& a, std::span<const Source> all) {
  constexpr std::size_t block = 32;
  struct Direction {
    Lanes inverse, nx, ny, nz;
  } direction[block];
  const Lanes a4 = 4 * a, a2_4 = 2.4 * a;
  Lanes ux, uy, uz, ox, oy, oz, exx, exy, exz, eyy, eyz, ezz;
  for (std::size_t first = 0; first < all.size(); first += block) {
    const std::span<const Source> sources = all.subspan(first, std::min(block, all.size() - first));
    for (std::size_t j = 0; j < sources.size(); ++j) {
      const Lanes rx = x - sources[j].x, ry = y - sources[j].y, rz = z - sources[j].z;
      const Lanes r2 = rx * rx + ry * ry + rz * rz;
      const Lanes inverse = where_greater(r2, 0, inverse_root(r2), 0);  // the sphere itself adds nothing
      direction[j] = {inverse, rx * inverse, ry * inverse, rz * inverse};
    }
    for (std::size_t j = 0; j < sources.size(); ++j) {
      const Source& q = sources[j];
      const auto& [i1, nx, ny, nz] = direction[j];
      const Lanes i2 = i1 * i1, i3 = i2 * i1, i4 = i2 * i2;
      const Lanes au = a4 + q.b2_4, ae = a2_4 + q.b4;
      const Lanes c = (au + ae) * i3;  // 6.4 (a + b)/r^3
      const Lanes us = i4 * au, ef = i4 * ae;
      const Lanes fn = q.Fx * nx + q.Fy * ny + q.Fz * nz, tn = q.Tx * nx + q.Ty * ny + q.Tz * nz;
      const Lanes sx = q.Sxx * nx + q.Sxy * ny + q.Sxz * nz;
      const Lanes sy = q.Sxy * nx + q.Syy * ny + q.Syz * nz;
      const Lanes sz = q.Sxz * nx + q.Syz * ny + q.Szz * nz;
      const Lanes sn = sx * nx + sy * ny + sz * nz;
      const Lanes tx = q.Ty * nz - q.Tz * ny, ty = q.Tz * nx - q.Tx * nz, tz = q.Tx * ny - q.Ty * nx;

      // Sums are written x = x + ... so that every term is one fused operation.
      const Lanes uf = i1 + 2 / 6.4 * c, un = (i1 - 6 / 6.4 * c) * fn + (i2 - 2.5 * us) * sn;
      ux = ux + uf * q.Fx + i2 * tx + us * sx + un * nx;
      uy = uy + uf * q.Fy + i2 * ty + us * sy + un * ny;
      uz = uz + uf * q.Fz + i2 * tz + us * sz + un * nz;

      // (F/r^2 + 3 S n/r^3) x n, and the torque's dipole
      const Lanes gx = i2 * q.Fx + i3 * sx, gy = i2 * q.Fy + i3 * sy, gz = i2 * q.Fz + i3 * sz;
      const Lanes ot = 0.5 * i3, on = 3 * ot * tn;
      ox = ox + gy * nz - gz * ny + on * nx - ot * q.Tx;
      oy = oy + gz * nx - gx * nz + on * ny - ot * q.Ty;
      oz = oz + gx * ny - gy * nx + on * nz - ot * q.Tz;

      // a third of the strain
      const Lanes eS = 0.125 * i2 * c, es = 2. / 3 * i3 - 10 * eS;
      const Lanes en = (17.5 * eS - 5. / 3 * i3) * sn - (i2 - 2.5 * ef) * fn;
      const Lanes kx = es * sx - ef * q.Fx - i3 * tx + en * nx;
      const Lanes ky = es * sy - ef * q.Fy - i3 * ty + en * ny;
      const Lanes kz = es * sz - ef * q.Fz - i3 * tz + en * nz;
      const Lanes e2 = eS + eS;
      exx = exx + kx * nx + eS * q.Sxx;
      eyy = eyy + ky * ny + eS * q.Syy;
      ezz = ezz + kz * nz + eS * q.Szz;
      exy = exy + kx * ny + ky * nx + e2 * q.Sxy;
      exz = exz + kx * nz + kz * nx + e2 * q.Sxz;
      eyz = eyz + ky * nz + kz * ny + e2 * q.Syz;
    }
  }
  return {{ux, uy, uz}, {ox, oy, oz}, {3 * exx, 1.5 * exy, 1.5 * exz, 3 * eyy, 1.5 * eyz, 3 * ezz}};
}

}  // namespace

FarFieldSum::FarFieldSum(const Spheres& s) : n_(s.size()) {
  const auto length = static_cast<std::size_t>((n_ + width - 1) / width * width);
  // Padding stands at the last sphere; nobody asks what it feels.
  x_.assign(length, s.position.back().x());
  y_.assign(length, s.position.back().y());
  z_.assign(length, s.position.back().z());
  radius2_.assign(length, 1.0);
  for (int i = 0; i < n_; ++i) {
    x_[i] = s.position[i].x(), y_[i] = s.position[i].y(), z_[i] = s.position[i].z();
    radius2_[i] = s.radius[i] * s.radius[i] / 6;
    self_.emplace_back(s.radius[i]);
  }
}

void FarFieldSum::apply(const double* q, double* w) const {
  const double* q_motion = q + 5 * n_;
  double* w_motion = w + 5 * n_;
  std::vector<Source> sources;
  sources.reserve(static_cast<std::size_t>(n_));
  for (int i = 0; i < n_; ++i) {
    const double* m = q_motion + 6 * i;
    const Eigen::Matrix3d S = 3 * strain_tensor(Eigen::Map<const Vector5>(q + 5 * i));
    sources.push_back({x_[i], y_[i], z_[i], 2.4 * radius2_[i], 4 * radius2_[i], m[0], m[1], m[2], m[3], m[4], m[5],
                       S(0, 0), S(0, 1), S(0, 2), S(1, 1), S(1, 2), S(2, 2)});
  }
  constexpr double oseen = 1 / (8 * std::numbers::pi);
#pragma omp parallel for schedule(static) if (n_ > 1000)
  for (int first = 0; first < n_; first += width) {
    const Field f = field_at(Lanes::load(&x_[first]), Lanes::load(&y_[first]), Lanes::load(&z_[first]),
                             Lanes::load(&radius2_[first]), sources);
    for (int i = first; i < std::min(n_, first + width); ++i) {
      const int k = i - first;
      Eigen::Matrix3d E;
      E << f.e[0][k], f.e[1][k], f.e[2][k], f.e[1][k], f.e[3][k], f.e[4][k], f.e[2][k], f.e[4][k], f.e[5][k];
      Eigen::Map<Vector5>(w + 5 * i) =
          oseen * strain_components(E) + self_[i].stresslet * Eigen::Map<const Vector5>(q + 5 * i);
      for (int c = 0; c < 3; ++c) {
        w_motion[6 * i + c] = oseen * f.u[c][k] + self_[i].force * q_motion[6 * i + c];
        w_motion[6 * i + 3 + c] = oseen * f.omega[c][k] + self_[i].torque * q_motion[6 * i + 3 + c];
      }
    }
  }
}

}  // namespace crumble

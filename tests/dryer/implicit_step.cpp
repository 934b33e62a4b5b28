#include "dryer/implicit_step.hpp"

#include <gtest/gtest.h>

#include "common/agglomerate/bond.hpp"
#include "common/numerics/noise.hpp"
#include "dryer/drag.hpp"
#include "dryer/implicit.hpp"
#include "tests/dryer/samples.hpp"

using namespace crumble;
using namespace crumble::dryer;
using namespace crumble::dryer::samples;

namespace {

constexpr double a = 10e-9;

TEST(BlockCholesky, solves_as_a_dense_solver_does) {
  const std::vector<BlockPair> pairs{{0, 3}, {3, 1}, {4, 0}, {2, 4}, {1, 2}};
  BlockCholesky sparse;
  sparse.set_pattern(5, pairs);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(30, 30);
  std::uint64_t draw = 0;
  const auto random_block = [&] {
    Matrix6 block;
    for (double& x : block.reshaped()) x = random_normals(1, Purpose::radius, 0, draw++)[0];
    return block;
  };
  for (int refill = 0; refill < 2; ++refill) {
    dense.setZero();
    sparse.clear();
    for (int p = 0; p < 5; ++p) {
      const Matrix6 B = random_block(), block = B * B.transpose() + 40 * Matrix6::Identity();
      dense.block<6, 6>(6 * p, 6 * p) += block;
      sparse.add_diagonal(p, block);
    }
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const Matrix6 block = random_block();
      dense.block<6, 6>(6 * pairs[k].i, 6 * pairs[k].j) += block;
      dense.block<6, 6>(6 * pairs[k].j, 6 * pairs[k].i) += block.transpose();
      sparse.add_pair(k, block);
    }
    std::vector<Vector6> right(5), solution;
    Eigen::VectorXd b(30);
    for (int p = 0; p < 5; ++p) b.segment<6>(6 * p) = right[p] = random_block().col(0);
    ASSERT_TRUE(sparse.factorise());
    sparse.solve(right, solution);
    const Eigen::VectorXd x = dense.llt().solve(b);
    for (int p = 0; p < 5; ++p) EXPECT_LT((solution[p] - x.segment<6>(6 * p)).norm(), 1e-13 * x.norm());
  }
}

TEST(BlockCholesky, refuses_an_indefinite_matrix) {
  BlockCholesky sparse;
  sparse.set_pattern(1, {});
  sparse.add_diagonal(0, -Matrix6::Identity());
  EXPECT_FALSE(sparse.factorise());
}

// A ring of five bonded spheres at the surface, every spring loaded.
struct Ring {
  DryingModel model = hollow();
  Agglomerate state;
  Ring() {
    std::vector<Vector3> x;
    const BondLaw law(model.contact, model.material, a, a);
    const double r = (a + 0.5 * law.equilibrium_gap()) / std::sin(std::numbers::pi / 5);
    for (int p = 0; p < 5; ++p)
      x.emplace_back(r * std::cos(0.4 * std::numbers::pi * p), r * std::sin(0.4 * std::numbers::pi * p), 1e-10 * p);
    state = spheres(x);
    for (const auto& [i, j] : {std::pair{0, 1}, {0, 4}, {1, 2}, {2, 3}, {3, 4}})
      state.state.contacts.push_back(make_bond(law, i, j, x[j] - x[i], a, a, 0));
    for (Contact& c : state.state.contacts) {
      c.rolling = 5e-3 * c.normal.cross(Vector3::UnitZ());
      c.sliding = 3e-11 * c.normal.cross(Vector3(0, 0.3, 1));
      c.twisting = 0.02;
      evaluate_loads(c, law);
    }
    model.droplet.initial_radius = r;
  }
};

TEST(ImplicitStep, ends_where_drag_and_forces_at_the_end_balance) {
  Ring ring;
  const BondLaws laws(ring.model.contact, ring.model.material, ring.state.particles.radius);
  ImplicitStep implicit(ring.model, ring.state, laws);
  implicit.set_network({0, 1, 2, 3, 4});
  const double dt = 1e-9, R = 0.999 * ring.model.droplet.initial_radius;
  ASSERT_TRUE(implicit.solve(dt, R, 1e-10 * a).converged);

  // Forces at the end by the other code path: the bonds advanced by the increments, as the inertial integrator does.
  std::vector<Vector3> force(5), torque(5);
  Frame& f = ring.state.state;
  for (int p = 0; p < 5; ++p) {
    f.position[p] += implicit.translation(p);
    const double r = f.position[p].norm();
    force[p] = -capillary_force(ring.model.droplet.surface_tension, a, r - R) / r * f.position[p];
    torque[p].setZero();
  }
  for (Contact& c : f.contacts) {
    advance(c, laws(c.i, c.j),
            {f.position[c.j] - f.position[c.i], implicit.translation(c.j) - implicit.translation(c.i),
             implicit.rotation(c.i), implicit.rotation(c.j), a, a});
    force[c.j] += force_on_j(c);
    force[c.i] -= force_on_j(c);
    torque[c.i] += torque_on_i(c, lever_arm(c, a, a));
    torque[c.j] += torque_on_j(c, lever_arm(c, a, a));
  }
  const double zeta = drag_coefficient(1e-3, a), zeta_r = rotational_drag_coefficient(1e-3, a);
  for (int p = 0; p < 5; ++p) {
    // The directions of the spring forces differ by the rotation of the bonds in the step, 1e-3 here.
    const double scale = 1e-10;  // N, the elastic forces in the ring
    EXPECT_LT((zeta / dt * implicit.translation(p) - force[p]).norm(), 2e-3 * scale) << p;
    EXPECT_LT((zeta_r / dt * implicit.rotation(p) - torque[p]).norm(), 2e-3 * scale * a) << p;
  }
}

TEST(ImplicitStep, moves_a_free_particle_at_the_surface_with_first_order_accuracy) {
  // zeta dx/dt = -F_c(x - R), R fixed: quadrature of dx/F_c gives the exact time; compare at the end of the run.
  DryingModel model = hollow();
  model.droplet.lifetime = 1e9;
  const double R = model.droplet.initial_radius, end = 1e-7;
  const double zeta = drag_coefficient(model.viscosity, a);
  const auto run = [&](int steps) {
    Agglomerate state = spheres({Vector3(0, 0, R - 0.5 * a)});
    const BondLaws laws(model.contact, model.material, state.particles.radius);
    ImplicitStep implicit(model, state, laws);
    implicit.set_network({0});
    for (int k = 0; k < steps; ++k) {
      implicit.increments()[0].setZero();
      EXPECT_TRUE(implicit.solve(end / steps, R, 1e-12 * a).converged);
      state.state.position[0] += implicit.translation(0);
    }
    return state.state.position[0].z() - R;
  };
  // Exact: offset = -a cos(phi), dphi/dt = -2 pi sigma/zeta until phi = 0.
  const double phi = std::acos(0.5) - 2 * std::numbers::pi * model.droplet.surface_tension / zeta * end;
  const double exact = phi > 0 ? -a * std::cos(phi) : -a;
  double before = 0;
  for (const int steps : {200, 400, 800}) {
    const double error = std::abs(run(steps) - exact);
    EXPECT_LT(error, 0.02 * a);
    if (before > 0) {
      EXPECT_NEAR(before / error, 2, 0.5);
    }
    before = error;
  }
}

TEST(ImplicitStep, converges_for_step_lengths_over_eight_decades) {
  for (const double dt : {1e-14, 1e-12, 1e-10, 1e-8, 1e-6}) {
    Ring ring;
    const BondLaws laws(ring.model.contact, ring.model.material, ring.state.particles.radius);
    ImplicitStep implicit(ring.model, ring.state, laws);
    implicit.set_network({0, 1, 2, 3, 4});
    EXPECT_TRUE(implicit.solve(dt, 0.99 * ring.model.droplet.initial_radius, 1e-6 * a).converged) << dt;
  }
}

}  // namespace

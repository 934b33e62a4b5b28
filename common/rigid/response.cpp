#include "common/rigid/response.hpp"

namespace crumble {

namespace {

// Eigenvalues ascending, with eigenvectors that form a rotation.
struct Axes {
  Vector3 value;
  Eigen::Matrix3d vector;
};

Axes axes(const Eigen::Matrix3d& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(symmetric);
  Axes a{solver.eigenvalues(), solver.eigenvectors()};
  if (a.vector.determinant() < 0) a.vector.col(0) *= -1;
  return a;
}

Eigen::Matrix3d strain_of(const Eigen::Matrix3d& gradient) { return 0.5 * (gradient + gradient.transpose()); }

Vector3 eigenvalues(const Eigen::Matrix3d& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace

Response respond(const Network& network, const RigidBodyResponse& body) {
  Response r;
  r.centre = body.centre;
  r.drag = body.drag;
  r.drift = body.drift;
  BondLoads bonds = network.solve(body.free_loads);
  r.load = std::move(bonds.load);
  r.imbalance = bonds.imbalance;
  r.residual = bonds.residual;
  std::vector<Vector3> normal;
  for (int b = 0; b < static_cast<int>(network.joints().size()); ++b) normal.push_back(network.normal(b));
  r.tension = tension_rows(r.load, normal);
  return r;
}

Eigen::MatrixXd tension_rows(const Eigen::MatrixXd& load, const std::vector<Vector3>& normal) {
  Eigen::MatrixXd tension(static_cast<Eigen::Index>(normal.size()), load.cols());
  for (Eigen::Index b = 0; b < tension.rows(); ++b) tension.row(b) = -normal[b].transpose() * load.middleRows(6 * b, 3);
  return tension;
}

double worst_tension(const Vector5& a, const Eigen::Matrix3d& strain) {
  return eigenvalues(strain_tensor(a)).dot(eigenvalues(strain_of(strain)));
}

Eigen::Matrix3d worst_orientation(const Vector5& a, const Eigen::Matrix3d& strain) {
  return axes(strain_of(strain)).vector * axes(strain_tensor(a)).vector.transpose();
}

WorstContact worst_contact(const Eigen::MatrixXd& tension, const std::vector<double>& pull_off,
                           const Eigen::Matrix3d& strain) {
  WorstContact worst;
  const Vector3 e = eigenvalues(strain_of(strain));
  double largest = 0;
  for (Eigen::Index b = 0; b < tension.rows(); ++b) {
    const double n = eigenvalues(strain_tensor(tension.row(b).transpose())).dot(e);
    if (worst.contact >= 0 && n / pull_off[b] <= largest) continue;
    worst = {static_cast<int>(b), n};
    largest = n / pull_off[b];
  }
  return worst;
}

}  // namespace crumble

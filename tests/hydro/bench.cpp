// Time and error of every rung of the hydrodynamic ladder, side by side.
//
//   bench_hydro [folder for CSV files, "" for none] [largest number of spheres] [tables: convergence ladder ...]
//
// Times are the shortest of several; those of one thread are processor time, those of more are wall clock.
#include <fmt/format.h>
#include <omp.h>
#include <unistd.h>

#include <chrono>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <numbers>
#include <random>
#include <set>

#include "common/hydro/dense_hydrodynamics.hpp"
#include "common/hydro/lagged_hydrodynamics.hpp"
#include "common/hydro/matrix_free.hpp"
#include "common/hydro/multipole.hpp"
#include "common/hydro/rigid_body.hpp"
#include "elastic_network.hpp"
#include "lattice.hpp"

using namespace crumble;
using namespace crumble::testing;

namespace {

double now() {
  if (omp_get_max_threads() > 1)
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

template <class Do>
double seconds(const Do& work, double at_least = 0.2, int most = 20) {
  double best = 1e300, total = 0;
  for (int k = 0; k < most && (k == 0 || total < at_least); ++k) {
    const double begin = now();
    work();
    const double t = now() - begin;
    best = std::min(best, t);
    total += t;
  }
  return best;
}

// One table: to the terminal in columns, to a file of the same name with commas.
class Table {
 public:
  Table(const std::string& folder, const std::string& name, const std::string& title, std::vector<std::string> heads)
      : heads_(std::move(heads)), csv_(folder.empty() ? std::ofstream() : std::ofstream(folder + "/" + name + ".csv")) {
    std::cout << "\n" << title << "\n";
    row(heads_);
  }
  void row(const std::vector<std::string>& cells) {
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const int width = static_cast<int>(std::max<std::size_t>(heads_[k].size(), 9));
      std::cout << (k == 0 ? fmt::format("{:<30}", cells[k]) : fmt::format("  {:>{}}", cells[k], width));
      csv_ << (k == 0 ? "" : ",") << cells[k];
    }
    std::cout << std::endl;
    csv_ << "\n";
  }

 private:
  std::vector<std::string> heads_;
  std::ofstream csv_;
};

std::string number(double x) { return fmt::format("{:.3g}", x); }
std::string percent(double x) { return fmt::format("{:+.2f}", 100 * x); }
std::string milliseconds(double t) { return number(1e3 * t); }

std::string name_of(const HydroModel& model) {
  switch (model.rung) {
    case Rung::fts:
      return "fts";
    case Rung::fts_lubrication:
      return "fts-lubrication";
    case Rung::fts_relative_lubrication:
      return "fts-relative-lubrication";
    case Rung::multipole:
      break;
  }
  return fmt::format("multipole L = {}", model.order);
}

HydroModel on(Rung rung, double range = HydroModel{}.lubrication_range) {
  HydroModel m{rung};
  m.lubrication_range = range;
  return m;
}
HydroModel of_order(int order) { return {Rung::multipole, order}; }

struct Cost {
  double assembly, factor, solve;
};

// One thread or as many as there are; the solve is one mobility problem.
template <class Scalar>
Cost dense_cost(const Spheres& s, const HydroModel& model, double at_least = 0.2) {
  Cost cost{};
  MobilityMatrix matrix = mobility_matrix(s, model);
  Eigen::SparseMatrix<double> near;
  cost.assembly = seconds(
      [&] {
        if (model.rung == Rung::multipole)
          matrix = mobility_matrix(s, model);
        else
          assemble_far_field(s, matrix);
        near = lubrication(s, model).motion_resistance(s.size());
      },
      at_least);
  std::optional<ConstrainedFactor<Scalar>> factor;
  const bool once = matrix.lower.rows() > 8000;  // a second copy might not fit
  const double copy = once ? 0 : seconds([&] { const MobilityMatrix another = matrix; }, at_least);
  cost.factor = seconds([&] { factor.emplace(once ? std::move(matrix) : matrix, near); }, once ? 0 : at_least) - copy;
  const Eigen::VectorXd load = wave(factor->interior() + factor->motion());
  typename ConstrainedFactor<Scalar>::Matrix x, velocity;
  cost.solve = seconds(
      [&] {
        x = load.cast<Scalar>();
        factor->solve_mobility(x, &velocity);
      },
      at_least);
  return cost;
}

// What a rigid cluster is judged by: mean drag, and the largest tension of a contact over all orientations of planar
// elongation.
struct Numbers {
  double drag, tension;
  Eigen::ArrayXd turned;  // the largest tension in each of 200 random orientations
};

Eigen::ArrayXd tension_turned(const Eigen::MatrixXd& by_strain) {
  Eigen::ArrayXd result(200);
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  for (double& t : result) {
    const Eigen::Quaterniond q(normal(engine), normal(engine), normal(engine), normal(engine));
    const Eigen::Matrix3d R = q.normalized().toRotationMatrix();
    t = (by_strain * strain_components(R * Vector3(0.5, 0, -0.5).asDiagonal() * R.transpose())).maxCoeff();
  }
  return result;
}

Numbers numbers(const DriedCluster& c, const HydroModel& model) {
  const RigidBodyResponse r =
      rigid_body_response(DenseHydrodynamics(c.spheres, 1, model), c.spheres.position, Vector3::Zero());
  const Eigen::MatrixXd tension = bond_tension(c.spheres, c.bonds, r.free_loads) / (6 * std::numbers::pi);
  return {r.drag.topLeftCorner<3, 3>().trace() / (18 * std::numbers::pi), worst_orientation(tension),
          tension_turned(tension)};
}

// Clusters of tests/hydro/dried and the order of multipoles that stands for the truth.
const std::vector<std::pair<std::string, int>> dried = {{"compact_85", 5}, {"granule_85", 5}, {"hollow_115", 4}};

void ladder(const std::string& folder) {
  Table table(
      folder, "ladder", "The ladder on dried clusters; errors against the last row of each.",
      {"method", "spheres", "threads", "assembly ms", "factor ms", "solve ms", "drag", "error %", "N_max", "error %"});
  for (const auto& [cluster, highest] : dried) {
    const DriedCluster c = dried_cluster(cluster);
    omp_set_num_threads(omp_get_num_procs());
    const Numbers exact = numbers(c, of_order(highest));
    omp_set_num_threads(1);
    std::vector<HydroModel> models = {on(Rung::fts), on(Rung::fts_lubrication), on(Rung::fts_relative_lubrication)};
    for (int order = 2; order <= highest; ++order) models.push_back(of_order(order));
    for (const HydroModel& model : models) {
      const Numbers found = model.order == highest && model.rung == Rung::multipole ? exact : numbers(c, model);
      const Cost cost = dense_cost<double>(c.spheres, model);
      table.row({name_of(model), std::to_string(c.spheres.size()), "1", milliseconds(cost.assembly),
                 milliseconds(cost.factor), milliseconds(cost.solve), fmt::format("{:.4f}", found.drag),
                 percent(found.drag / exact.drag - 1), fmt::format("{:.4f}", found.tension),
                 percent(found.tension / exact.tension - 1)});
    }
  }
}

void cut_off(const std::string& folder) {
  std::vector<std::string> heads = {"pairs closer than (a)"};
  std::vector<DriedCluster> clusters;
  std::vector<Numbers> exact;
  omp_set_num_threads(omp_get_num_procs());
  for (const auto& [name, highest] : dried) {
    heads.insert(heads.end(), {fmt::format("{} L = {}", name, highest), "rms", "worst"});
    clusters.push_back(dried_cluster(name));
    exact.push_back(numbers(clusters.back(), of_order(highest)));
  }
  Table table(folder, "cut_off",
              "Relative lubrication: error in % of N_max against multipoles of order L, by the pairs it takes; rms and "
              "worst\nerror of the largest tension in 200 single orientations.",
              heads);
  const auto row = [&](const std::string& name, const HydroModel& model) {
    std::vector<std::string> cells = {name};
    for (std::size_t k = 0; k < clusters.size(); ++k) {
      const Numbers found = numbers(clusters[k], model);
      const Eigen::ArrayXd turned = found.turned / exact[k].turned - 1;
      cells.insert(cells.end(), {percent(found.tension / exact[k].tension - 1),
                                 fmt::format("{:.2f}", 100 * std::sqrt(turned.square().mean())),
                                 fmt::format("{:.2f}", 100 * turned.abs().maxCoeff())});
    }
    table.row(cells);
  };
  row("none (fts)", on(Rung::fts));
  for (const double range : {2.01, 2.1, 2.25, 2.5, 3.0, 4.0, 6.0})
    row(number(range), on(Rung::fts_relative_lubrication, range));
  for (const double range : {2.01, 2.5, 4.0})
    row(fmt::format("as printed: {}", number(range)), on(Rung::fts_lubrication, range));
}

Spheres scaled_distances(Spheres s, double factor) {
  for (Vector3& x : s.position) x *= factor;
  return s;
}

void lagged(const std::string& folder) {
  omp_set_num_threads(1);
  Table table(
      folder, "lagged",
      "One mobility solve with ambient flow and relative lubrication, one thread: fresh, and with the factor of "
      "a configuration\nfrom which every sphere has moved by so much; error of the velocities against a dense "
      "float64 solve.",
      {"factor", "spheres", "fresh ms", "moved (a)", "lagged ms", "iterations", "products", "error"});
  const HydroModel model = on(Rung::fts_relative_lubrication);
  const LinearFlow flow = {Vector3(0.1, 0.2, 0.3), simple_shear(1).gradient};
  // Contacts overlap by 1.88e-3 a as dried ones do.
  const auto pressed = [](int n) { return scaled_distances(grown({n, 0, 1e9, 12, 0, 1}), 1 - 0.94e-3); };
  for (const Spheres& s :
       {dried_cluster("compact_85").spheres, dried_cluster("hollow_115").spheres, pressed(250), pressed(500)})
    for (const bool single : {true, false}) {
      const Eigen::VectorXd load = wave(6 * s.size());
      const double fresh = seconds([&] { LaggedHydrodynamics(s, 1, model, {1e-8, 30, single}).mobility(load, flow); });
      for (const double distance : {1e-6, 1e-5, 1e-4}) {
        LaggedHydrodynamics hydro(s, 1, model, {1e-8, 60, single});
        std::vector<Vector3> x = s.position;
        for (std::size_t k = 0; k < x.size(); ++k) {
          const double phase = static_cast<double>(k);
          x[k] +=
              distance * Vector3(std::sin(3 * phase), std::sin(5 * phase + 1), std::sin(7 * phase + 2)).normalized();
        }
        SphereMotion motion;
        long products = 0;
        const double time = seconds([&] {
          const long before = hydro.work().products;
          hydro.update(x);
          motion = hydro.mobility(load, flow);
          products = hydro.work().products - before;
        });
        Spheres moved = s;
        moved.position = x;
        const SphereMotion exact = DenseHydrodynamics(moved, 1, model).mobility(load, flow);
        table.row({single ? "float32" : "float64", std::to_string(s.size()), milliseconds(fresh),
                   fmt::format("{:.0e}", distance), milliseconds(time), std::to_string(hydro.work().iterations),
                   std::to_string(products),
                   fmt::format("{:.1e}", (motion.velocity - exact.velocity).norm() / exact.velocity.norm())});
      }
    }
}

// Exponent of a power law through the points, by least squares in logarithms.
double exponent(const std::vector<double>& n, const std::vector<double>& t) {
  const auto count = static_cast<Eigen::Index>(n.size());
  Eigen::MatrixXd A(count, 2);
  Eigen::VectorXd b(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    A.row(k) << 1, std::log(n[k]);
    b[k] = std::log(t[k]);
  }
  return A.colPivHouseholderQr().solve(b)[1];
}

double memory_gigabytes() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e9;
}

// The lower triangle in place and the smaller factor of its motion block: (11 N)^2 + (6 N)^2 numbers.
double dense_gigabytes(int n) { return 8e-9 * (121.0 + 36.0) * n * n; }

void growth(const std::string& folder, int most) {
  Table table(
      folder, "growth",
      "Growth with the number of spheres, compact clusters, relative lubrication. Product: the pair sum without "
      "a matrix; iterated: a mobility\nsolve with ambient flow by MatrixFreeHydrodynamics to 1e-8.",
      {"spheres", "threads", "assembly ms", "factor ms", "solve ms", "product ms", "ns per pair", "iterated ms",
       "iterations"});
  for (const int threads : std::set{1, omp_get_num_procs()}) {
    omp_set_num_threads(threads);
    struct Series {
      std::vector<double> n, time;
      std::string add(int count, double t) {
        n.push_back(count);
        time.push_back(t);
        return milliseconds(t);
      }
      std::string power() const { return fmt::format("N^{:.2f}", exponent(n, time)); }
    } assembly, factor, solve, product, iterated;
    for (const int count : {50, 100, 200, 500, 1000, 2000}) {
      if (count > most) break;
      const HydroModel model = on(Rung::fts_relative_lubrication);
      const Spheres s = grown({count, 0, 1e9, 12, 0, 1});
      std::vector<std::string> cells = {std::to_string(count), std::to_string(threads)};
      if (dense_gigabytes(count) < 0.7 * memory_gigabytes()) {
        const Cost cost = dense_cost<double>(s, model);
        cells.insert(cells.end(), {assembly.add(count, cost.assembly), factor.add(count, cost.factor),
                                   solve.add(count, cost.solve)});
      } else {
        cells.insert(cells.end(), 3, "does not fit");
      }
      const FarFieldSum sum(s);
      const Eigen::VectorXd q = wave(11 * count);
      Eigen::VectorXd w(q.size());
      const double t = seconds([&] { sum.apply(q.data(), w.data()); });
      cells.insert(cells.end(), {product.add(count, t), fmt::format("{:.2f}", 1e9 * t / count / count)});
      int iterations = 0;
      const double whole = seconds([&] {
        const MatrixFreeHydrodynamics hydro(s, 1, model);
        hydro.mobility(wave(6 * count), simple_shear(1));
        iterations = hydro.iterations();
      });
      cells.insert(cells.end(), {iterated.add(count, whole), std::to_string(iterations)});
      table.row(cells);
    }
    table.row({"growth", std::to_string(threads), assembly.power(), factor.power(), solve.power(), product.power(), "",
               iterated.power(), ""});
  }
}

void convergence(const std::string& folder) {
  omp_set_num_threads(omp_get_num_procs());
  Table table(folder, "convergence",
              "Convergence with L: drag over 6 pi mu a along and across the axis (least and largest), N_max over\n"
              "6 pi mu gamma_dot a^2 in the worst orientation.",
              {"cluster", "L", "drag", "drag", "N_max"});
  const std::vector<std::pair<std::string, Spheres>> clusters = {
      {"doublet", chain(2)},    {"linear trimer", chain(3)},    {"linear tetramer", chain(4)},
      {"triangle", triangle()}, {"tetrahedron", tetrahedron()}, {"octahedron", octahedron()}};
  for (const auto& [name, s] : clusters)
    for (const int order : {1, 2, 3, 4, 5, 6, 8, 10, 12}) {
      if (s.size() * multipole_unknowns(order) > 2500) break;
      const RigidBodyResponse r =
          rigid_body_response(DenseHydrodynamics(s, 1, of_order(order)), s.position, Vector3::Zero());
      const Eigen::Matrix3d K = r.drag.topLeftCorner<3, 3>();
      const Vector3 drag = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(K).eigenvalues() / (6 * std::numbers::pi);
      table.row({name, std::to_string(order), fmt::format("{:.6f}", drag[0]), fmt::format("{:.6f}", drag[2]),
                 fmt::format("{:.5f}", worst_orientation(bond_tension(s, touching_pairs(s), r.free_loads)) /
                                           (6 * std::numbers::pi))});
    }
}

// Rigid drag without a matrix; the dense answer where one fits. The drag is that of 6 right-hand sides.
void without_a_matrix(const std::string& folder, int most) {
  omp_set_num_threads(omp_get_num_procs());
  Table table(folder, "matrix_free",
              "Rigid drag of a compact cluster (10,000: a ball cut out of a cubic lattice) without a matrix, all "
              "cores; relative error of the 6 x 6 drag against "
              "a dense factor.\nneighbours: what a sphere keeps in the preconditioner (0: its own mobility only).",
              {"spheres", "threads", "neighbours", "tolerance", "iterations", "wall s", "dense s", "error"});
  for (const int n : {500, 2000, 10000}) {
    if (n > most) break;
    const Spheres s = n > 2000 ? lattice_ball(n) : grown({n, 0, 1e9, 12, 0, 1});
    const auto drag = [&](const Hydrodynamics& hydro) {
      Eigen::MatrixXd Z = Eigen::MatrixXd::Zero(6 * n, 6);
      for (int i = 0; i < n; ++i) {
        const Vector3 x = s.position[i];
        Z.block<6, 6>(6 * i, 0).setIdentity();
        Z.block<3, 3>(6 * i, 3) << 0, x.z(), -x.y(), -x.z(), 0, x.x(), x.y(), -x.x(), 0;
      }
      return Eigen::MatrixXd(-Z.transpose() * hydro.relative_resistance(Z, Eigen::MatrixXd::Zero(5, 6)).force_torque);
    };
    double dense = 0;
    Eigen::MatrixXd exact;
    if (n <= 2000) dense = seconds([&] { exact = drag(DenseHydrodynamics(s, 1, {})); }, 0);
    for (const int neighbours : {30, 0})
      for (const double tolerance : {1e-5, 1e-8}) {
        if (n > 2000 && tolerance < 1e-6) continue;
        const MatrixFreeHydrodynamics hydro(s, 1, {}, {.tolerance = tolerance, .neighbours = neighbours});
        Eigen::MatrixXd found;
        const double time = seconds([&] { found = drag(hydro); }, 0);
        table.row({std::to_string(n), std::to_string(omp_get_max_threads()), std::to_string(neighbours),
                   fmt::format("{:.0e}", tolerance), std::to_string(hydro.iterations()), number(time),
                   dense > 0 ? number(dense) : "",
                   dense > 0 ? fmt::format("{:.1e}", (found - exact).norm() / exact.norm()) : ""});
      }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string folder = argc > 1 ? argv[1] : "";
  const int most = argc > 2 ? std::atoi(argv[2]) : 10000;
  const std::vector<std::string> wanted(argv + std::min(argc, 3), argv + argc);
  if (!folder.empty()) std::filesystem::create_directories(folder);
  const auto table = [&](const char* name, const auto& print) {
    if (wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end()) print();
  };
  table("convergence", [&] { convergence(folder); });
  table("ladder", [&] { ladder(folder); });
  table("cut_off", [&] { cut_off(folder); });
  table("lagged", [&] { lagged(folder); });
  table("growth", [&] { growth(folder, std::min(most, 2000)); });
  table("matrix_free", [&] { without_a_matrix(folder, most); });
}

#include "rigidstress/hydrodynamic_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/hydro/dense_hydrodynamics.hpp"
#include "common/hydro/matrix_free.hpp"
#include "common/hydro/multipole.hpp"
#include "common/io/errors.hpp"

namespace crumble::rigidstress {

namespace {

constexpr double viscosity = 1;  // Pa s

Spheres spheres_of(const Network& network) { return {network.position(), network.radius()}; }

RigidBodyResponse rigid_response(const Network& network, const Vector3& centre, const HydroModel& model) {
  const DenseHydrodynamics hydrodynamics(spheres_of(network), viscosity, model);
  return rigid_body_response(hydrodynamics, network.position(), centre);
}

// Each is the work of minutes in large agglomerates.
template <class Compute>
RigidBodyResponse kept(DoneParts& parts, const std::string& name, Compute compute) {
  return parts.value(name, compute, [](SavedFields& f, RigidBodyResponse& body) { body.fields(f); });
}

// The far field, by a dense factor (N^3) where that is cheaper and fits, else by iterations (N^2): one core of this
// year takes 7 s to iterate at 1000 spheres and 12 s or more to factorise.
constexpr int iterate_from = 500;  // spheres

RigidBodyResponse far_field_response(const Network& network, const Vector3& centre, const HydrodynamicChoice& choice,
                                     const Say& say) {
  const int n = network.size();
  if (n < iterate_from && memory_needed(n, 1) <= choice.memory) return rigid_response(network, centre, {});
  say(fmt::format("fts of {} spheres by iteration without a matrix", n));
  const auto tell = [&](int column, int columns, int iterations) {
    if (n >= 3000) say(fmt::format("right-hand side {} of {}: {} iterations", column + 1, columns, iterations));
  };
  // A thousandth of the far field's own error.
  const MatrixFreeHydrodynamics hydrodynamics(spheres_of(network), viscosity, {},
                                              {.tolerance = 1e-5, .on_solved = tell});
  RigidBodyResponse body = rigid_body_response(hydrodynamics, network.position(), centre);
  // Loads known to 1e-5 leave a net load of that size, which the free body answers by moving: to round-off.
  Eigen::Matrix<double, 6, 6> resistance = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 5> net = Eigen::Matrix<double, 6, 5>::Zero();
  const double a = mean_radius(spheres_of(network));
  for (int i = 0; i < network.size(); ++i) {
    Eigen::Matrix<double, 6, 6> to_centre = Eigen::Matrix<double, 6, 6>::Identity();
    const Vector3 x = (network.position()[i] - centre) / a;
    to_centre.block<3, 3>(3, 0) << 0, -x.z(), x.y(), x.z(), 0, -x.x(), -x.y(), x.x(), 0;
    to_centre.block<3, 3>(3, 3) /= a;
    resistance += to_centre * body.motion_loads.middleRows(6 * i, 6);
    net += to_centre * body.free_loads.middleRows(6 * i, 6);
  }
  resistance.rightCols<3>() /= a;
  Eigen::Matrix<double, 6, 5> motion = -resistance.partialPivLu().solve(net);
  motion.bottomRows<3>() /= a;
  body.free_loads += body.motion_loads * motion;
  body.drift += motion;
  return body;
}

// Lubrication on relative motion only leaves drag and drift of a rigid body as they are; what it adds are loads by the
// strain between near neighbours, in balance for every pair. So the far field's solution serves for both rungs.
RigidBodyResponse with_relative_lubrication(const Network& network, RigidBodyResponse body, const HydroModel& model) {
  const Spheres spheres = spheres_of(network);
  const double a = mean_radius(spheres);
  const int n = network.size();
  Eigen::MatrixXd motion = Eigen::MatrixXd::Zero(6 * n, 5), strain(5 * n, 5);
  for (int i = 0; i < n; ++i) {
    motion.middleRows(6 * i, 3) = -strain_along((network.position()[i] - body.centre) / a);
    strain.middleRows(5 * i, 5) = -Eigen::Matrix<double, 5, 5>::Identity();
  }
  Eigen::MatrixXd force = Eigen::MatrixXd::Zero(6 * n, 5), stresslet = Eigen::MatrixXd::Zero(5 * n, 5);
  Lubrication(scaled(spheres, 1 / a), model.lubrication_range, PairMotion::relative, model.gap_floor)
      .add(motion, strain, force, stresslet);
  for (int i = 0; i < n; ++i) {
    body.free_loads.middleRows(6 * i, 3) -= viscosity * a * a * force.middleRows(6 * i, 3);
    body.free_loads.middleRows(6 * i + 3, 3) -= viscosity * a * a * a * force.middleRows(6 * i + 3, 3);
  }
  return body;
}

std::string outside_lubrication(const Network& network, const HydroModel& model) {
  return outside_lubrication(spheres_of(network), model.lubrication_range);
}
bool is_in_lubrication(const Network& network, const HydroModel& model) {
  return outside_lubrication(network, model).empty();
}

// Tension of each contact in its own worst orientation of a planar flow of unit rate.
Eigen::VectorXd worst_tensions(const Eigen::MatrixXd& tension) {
  const Eigen::Matrix3d flow = planar_elongation(1).gradient;
  Eigen::VectorXd worst(tension.rows());
  for (Eigen::Index b = 0; b < tension.rows(); ++b) worst[b] = worst_tension(tension.row(b).transpose(), flow);
  return worst;
}

std::string order_name(int order) { return order == 1 ? "fts" : fmt::format("multipole L = {}", order); }

// From relative changes of the largest tension: first what pair lubrication on relative motion changes in the far
// field, if known, then from one order to the next.
//
// With touching spheres the series converges like a power of L with a part that alternates between even and odd
// orders, so one small change may be chance. Each older change counts as well, by what it has usually come down to.
// Against converged clusters of 2 to 16 spheres this bounds the true error (tests).
double order_error(const std::vector<double>& changes) {
  constexpr double weight[] = {0.7, 0.4, 0.15};
  double error = 0;
  for (std::size_t k = 0; k < std::min<std::size_t>(3, changes.size()); ++k)
    error = std::max(error, weight[k] * changes[changes.size() - 1 - k]);
  return error;
}

void require_memory(int spheres, int order, double allowed) {
  const double needed = memory_needed(spheres, order);
  if (needed > allowed)
    throw TooLarge(fmt::format("{} of {} spheres needs {:.3g} GB for its factor, hydrodynamics.memory allows {:.3g} GB",
                               order_name(order), spheres, needed * 1e-9, allowed * 1e-9));
}

constexpr const char* by_lubrication = "twice what pair lubrication on relative motion changes, 3 % at least";
constexpr const char* no_lubrication =
    "not estimated: radii of near spheres differ by more than the 10 to 1 that lubrication is known for";
// In clusters of 2 to 115 spheres the far field's error is up to 1.7 times what lubrication changes, of either sign.
// What it misses of collective drag lubrication does not see: 2 % of the largest tension in a straight chain of 50.
double far_field_error(double change) { return std::max(0.03, 2 * change); }

// Climbs the orders one by one.
class Ladder {
 public:
  Ladder(const Network& network, const Vector3& centre, const HydrodynamicChoice& choice, const Say& say,
         DoneParts& parts)
      : network_(network), centre_(centre), choice_(choice), say_(say), parts_(parts) {}

  // The far field is the lowest order; what lubrication changes in it stands for the change before.
  void start() {
    const RigidBodyResponse far =
        kept(parts_, order_name(1), [&] { return far_field_response(network_, centre_, choice_, say_); });
    response_ = respond(network_, far);
    if (is_in_lubrication(network_, {})) {
      const Response with = respond(network_, with_relative_lubrication(network_, far, {}));
      changes_.push_back(tension_change(response_.tension, with.tension));
    }
    order_ = first_ = 1;
  }
  void climb(int order) {
    Response next = respond(network_, kept(parts_, order_name(order), [&] {
                              return rigid_response(network_, centre_, {Rung::multipole, order});
                            }));
    if (order_ > 0)
      changes_.push_back(tension_change(response_.tension, next.tension));
    else
      first_ = order;
    order_ = order;
    response_ = std::move(next);
  }
  Response& response() { return response_; }
  const std::vector<double>& changes() const { return changes_; }
  std::optional<double> error() const {
    if (changes_.empty()) return std::nullopt;
    return order_ == 1 ? far_field_error(changes_.front()) : order_error(changes_);
  }
  std::string how() const {
    if (changes_.empty()) return no_lubrication;
    if (order_ == 1) return by_lubrication;
    const bool lubricated = static_cast<int>(changes_.size()) == order_ && order_ < 4;
    return fmt::format("from the changes of the largest tensions between multipole orders {} to {}{}",
                       std::max(first_, order_ - 3), order_, lubricated ? " and by lubrication" : "");
  }

 private:
  const Network& network_;
  Vector3 centre_;
  const HydrodynamicChoice& choice_;
  const Say& say_;
  DoneParts& parts_;
  int order_ = 0, first_ = 0;
  Response response_;
  std::vector<double> changes_;
};

constexpr const char* by_far_field = "twice the difference to the far field without lubrication, 3 % at least";

Judged two_rungs(const Network& network, const Vector3& centre, const HydrodynamicChoice& choice, const Say& say,
                 DoneParts& parts) {
  if (choice.method == Method::fts_lubrication) require_memory(network.size(), 1, choice.memory);
  const bool in_lubrication = is_in_lubrication(network, choice.lubrication);
  if (choice.method != Method::fts && !in_lubrication)
    throw InputError(outside_lubrication(network, choice.lubrication) +
                     ". hydrodynamics.method = \"multipole\" or \"auto\" needs none");
  const RigidBodyResponse far =
      kept(parts, order_name(1), [&] { return far_field_response(network, centre, choice, say); });
  const Response without = respond(network, far);
  Judged result;
  if (choice.method == Method::fts_lubrication) {
    HydroModel model = choice.lubrication;
    model.rung = Rung::fts_lubrication;
    result.response =
        respond(network, kept(parts, "fts-lubrication", [&] { return rigid_response(network, centre, model); }));
    result.method = "fts-lubrication";
    result.how = "not estimated: pair lubrication on collective motion is not a step towards the exact solution";
    return result;
  }
  if (!in_lubrication) return {without, "fts", std::nullopt, no_lubrication};
  const Response with = respond(network, with_relative_lubrication(network, far, choice.lubrication));
  result.response = choice.method == Method::fts ? without : with;
  result.method = choice.method == Method::fts ? "fts" : "fts-relative-lubrication";
  result.error = choice.method == Method::fts ? far_field_error(tension_change(without.tension, with.tension))
                                              : far_field_error(tension_change(with.tension, without.tension));
  result.how = choice.method == Method::fts ? by_lubrication : by_far_field;
  return result;
}

Judged one_order(const Network& network, const Vector3& centre, const HydrodynamicChoice& choice, const Say& say,
                 DoneParts& parts) {
  require_memory(network.size(), choice.order, choice.memory);
  Ladder ladder(network, centre, choice, say, parts);
  // Three changes are what the estimate looks at; lower orders cost little.
  const int first = choice.estimate ? std::max(1, choice.order - 3) : choice.order;
  if (first == 1 && choice.estimate) ladder.start();
  for (int order = choice.estimate && first == 1 ? 2 : first; order <= choice.order; ++order) ladder.climb(order);
  Judged result;
  result.method = order_name(choice.order);
  if (ladder.changes().empty()) {
    result.how = "not estimated: a single order was computed";
  } else {
    result.error = ladder.error();
    result.how = ladder.how();
  }
  result.response = std::move(ladder.response());
  return result;
}

Judged cheapest(const Network& network, const Vector3& centre, const HydrodynamicChoice& choice, const Say& say,
                DoneParts& parts) {
  Judged result;
  Ladder ladder(network, centre, choice, say, parts);
  for (int order = 1; order <= highest_multipole_order; ++order) {
    if (order > 1 && memory_needed(network.size(), order) > choice.memory) {
      say(fmt::format(
          "stopped at {}: {} needs {:.3g} GB, hydrodynamics.memory allows {:.3g} GB; its error is "
          "estimated above the tolerance",
          result.method, order_name(order), memory_needed(network.size(), order) * 1e-9, choice.memory * 1e-9));
      break;
    }
    if (order == 1)
      ladder.start();
    else
      ladder.climb(order);
    result.error = ladder.error();
    result.how = ladder.how();
    result.method = order_name(order);
    result.within_tolerance = result.error && *result.error <= choice.accuracy;
    if (result.error)
      say(fmt::format("{}: largest tension within {:.2g} % (estimate)", result.method, 100 * *result.error));
    if (result.within_tolerance) break;
  }
  result.response = std::move(ladder.response());
  return result;
}

}  // namespace

double memory_needed(int spheres, int order) {
  const double unknowns = static_cast<double>(spheres) * multipole_unknowns(order);
  return 8 * unknowns * unknowns;
}

double tension_change(const Eigen::MatrixXd& before, const Eigen::MatrixXd& after) {
  if (after.rows() == 0) return 0;
  const Eigen::VectorXd old = worst_tensions(before), now = worst_tensions(after);
  const double largest = now.maxCoeff();
  double change = 0;
  for (Eigen::Index b = 0; b < now.size(); ++b)
    if (now[b] >= 0.5 * largest) change = std::max(change, std::abs(now[b] - old[b]));
  return largest > 0 ? change / largest : 0;
}

Judged judged_response(const Network& network, const Vector3& centre, const HydrodynamicChoice& choice, const Say& say,
                       DoneParts& parts) {
  if (choice.method == Method::fts_lubrication)
    say("warning: fts-lubrication acts on the collective motion of near pairs and adds up over neighbours; in a rigid "
        "cluster it overestimates drag and tensions by tens of per cent. It is here to reproduce older work.");
  switch (choice.method) {
    case Method::automatic:
      return cheapest(network, centre, choice, say, parts);
    case Method::multipole:
      return one_order(network, centre, choice, say, parts);
    default:
      return two_rungs(network, centre, choice, say, parts);
  }
}

}  // namespace crumble::rigidstress

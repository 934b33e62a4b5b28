// Time against error of the hydrodynamic methods: what a run pays for how good a largest tension.
//
//   bench_rigidstress [largest number of spheres]
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "rigidstress/flows.hpp"
#include "rigidstress/hydrodynamic_choice.hpp"
#include "tests/hydro/clusters.hpp"

using namespace crumble;
using namespace crumble::rigidstress;

namespace {

constexpr double radius = 1e-7;

Network network_of(const Spheres& unit) {
  std::vector<Vector3> position;
  std::vector<Joint> joints;
  for (const Vector3& x : unit.position) position.push_back(radius * x);
  for (int i = 0; i < unit.size(); ++i)
    for (int j = i + 1; j < unit.size(); ++j)
      if ((unit.position[i] - unit.position[j]).norm() < 2 + 1e-6)
        joints.push_back(make_joint({}, Material{}, i, j, radius, radius));
  return {position, std::vector<double>(position.size(), radius), joints};
}

double processor_seconds() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

struct Row {
  Judged found;
  double wall, processor;
  int order;
};

Row measured(const Network& net, const HydrodynamicChoice& choice) {
  Vector3 centre = Vector3::Zero();
  for (const Vector3& x : net.position()) centre += x / static_cast<double>(net.size());
  const double before = processor_seconds();
  const auto begin = std::chrono::steady_clock::now();
  DoneParts parts;
  Judged found = judged_response(
      net, centre, choice, [](const std::string&) {}, parts);
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return {std::move(found), wall, processor_seconds() - before, choice.method == Method::multipole ? choice.order : 1};
}

double largest(const Response& r) {
  return worst_contact(r.tension, std::vector<double>(r.tension.rows(), 1), unit_gradient(FlowKind::elongation))
      .tension;
}

void table(const char* name, const Spheres& unit, int highest_order) {
  const Network net = network_of(unit);
  std::vector<Row> rows;
  HydrodynamicChoice choice;
  choice.memory = 2e9;  // L = 2 at 500 spheres, not L = 3, which would take minutes
  rows.push_back(measured(net, choice));
  for (const Method method : {Method::fts, Method::fts_relative_lubrication, Method::fts_lubrication}) {
    choice.method = method;
    rows.push_back(measured(net, choice));
  }
  choice.method = Method::multipole;
  for (choice.order = 2; choice.order <= highest_order; ++choice.order) rows.push_back(measured(net, choice));
  const Response& truth = rows.back().found.response;
  const double n = largest(truth), force = 6 * 3.14159265358979 * radius * radius;
  std::printf("\n%s: %d spheres, %zu contacts; errors against L = %d, which is itself within %.2g %%\n", name,
              net.size(), net.joints().size(), highest_order, 100 * *rows.back().found.error);
  std::printf("%-26s %8s %8s %9s %8s %9s %9s %9s\n", "method", "wall s", "CPU s", "matrix MB", "N_max", "error %",
              "contact %", "stated %");
  for (const Row& row : rows) {
    const bool automatic = &row == &rows.front();
    const std::string stated = row.found.error ? std::to_string(100 * *row.found.error).substr(0, 5) : "none";
    std::printf("%-26s %8.3f %8.3f %9.0f %8.4f %9.2f %9.2f %9s\n",
                ((automatic ? "auto: " : "") + row.found.method).c_str(), row.wall, row.processor,
                automatic ? 0.0 : 1e-6 * memory_needed(net.size(), row.order), largest(row.found.response) / force,
                100 * (largest(row.found.response) / n - 1),
                100 * tension_change(row.found.response.tension, truth.tension), stated.c_str());
  }
  std::fflush(stdout);
}

Spheres cube() {
  std::vector<Vector3> x;
  for (int k = 0; k < 8; ++k) x.emplace_back(2.0 * (k & 1), k & 2, (k & 4) / 2);
  return testing::unit_spheres(x);
}

}  // namespace

int main(int argc, char** argv) {
  const int most = argc > 1 ? std::atoi(argv[1]) : 500;
  std::printf(
      "Largest tension in planar elongation, worst orientation, in 6 pi mu gamma_dot a^2. Times include what the "
      "stated error needs.\nerror: of N_max; contact: largest among contacts that bear at least half of it.\n");
  table("cube", cube(), 8);
  if (most >= 85) table("compact", testing::compact_85(), 5);
  if (most >= 115) table("hollow", testing::hollow_115(), 4);
  if (most >= 500) table("compact", testing::grown({500, 0, 1e9, 12, 0, 1}), 2);
}

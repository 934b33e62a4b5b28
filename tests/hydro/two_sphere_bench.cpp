// Cost of one pair: build/release/bin/bench_two_sphere. The error that goes with it is asserted in
// two_sphere_table.cpp.
#include <benchmark/benchmark.h>

#include "common/hydro/two_sphere_pair.hpp"

namespace crumble {
namespace {

// Argument: gap in units of 1e-6. A new gap each time, so that nothing can be hoisted.
void equal_scalars(benchmark::State& state) {
  const double base = 1e-6 * static_cast<double>(state.range(0));
  double gap = base;
  for (auto _ : state) {
    benchmark::DoNotOptimize(two_sphere_resistance(gap));
    gap = gap > 1.1 * base ? base : gap * 1.0001;
  }
}
BENCHMARK(equal_scalars)->Arg(10)->Arg(1000)->Arg(50'000)->Arg(1'000'000)->Arg(5'000'000);

void unequal_scalars(benchmark::State& state) {
  const double base = 1e-6 * static_cast<double>(state.range(0));
  double gap = base;
  for (auto _ : state) {
    benchmark::DoNotOptimize(two_sphere_resistance(gap, 0.3));
    gap = gap > 1.1 * base ? base : gap * 1.0001;
  }
}
BENCHMARK(unequal_scalars)->Arg(10)->Arg(50'000)->Arg(5'000'000);

void pair_matrix(benchmark::State& state) {
  Eigen::Vector3d r(1.2, -0.7, 1.6);
  for (auto _ : state) {
    benchmark::DoNotOptimize(two_sphere_pair(r, 1, 1));
    r.x() = r.x() > 1.3 ? 1.2 : r.x() * 1.0001;
  }
}
BENCHMARK(pair_matrix);

}  // namespace
}  // namespace crumble

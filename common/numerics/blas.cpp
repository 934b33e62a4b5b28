#include "common/numerics/blas.hpp"

#include <cblas.h>
#include <omp.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cctype>

namespace crumble::blas {

namespace {

#if defined(EIGEN_VECTORIZE)
constexpr int eigen_bytes = EIGEN_MAX_STATIC_ALIGN_BYTES;
#else
constexpr int eigen_bytes = 0;
#endif

// OpenBLAS's names of its kernels on x86-64 that fill 32 bytes with fused multiply-add (AVX2), or 64 (AVX-512).
constexpr auto wide = std::to_array<std::string_view>({"HASWELL", "ZEN", "SKYLAKEX", "COOPERLAKE", "SAPPHIRERAPIDS"});

#if defined(__aarch64__)
constexpr bool on_arm = true;
#else
constexpr bool on_arm = false;
#endif

bool is_wide(std::string_view core) {
  std::string name(core);
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::toupper(c); });
  return std::find(wide.begin(), wide.end(), name) != wide.end();
}

}  // namespace

Kernels kernels_for(std::string_view core, int bytes) {
  // Every one of its kernels on arm64 has NEON, the registers that Eigen uses; some have SVE.
  if (on_arm) return core.empty() ? Kernels::eigen : Kernels::openblas;
  return is_wide(core) && bytes < 64 ? Kernels::openblas : Kernels::eigen;
}

Kernels kernels() {
  static const Kernels taken = [] {
    const OneThread guard;
    return kernels_for(openblas_get_corename(), eigen_bytes);
  }();
  return taken;
}

std::string description() {
  const std::string configuration = openblas_get_config();  // "OpenBLAS 0.3.21 NO_LAPACKE DYNAMIC_ARCH ..."
  const auto version_end = configuration.find(' ', configuration.find(' ') + 1);
  return configuration.substr(0, version_end) + ", core " + openblas_get_corename() +
         (kernels() == Kernels::openblas ? ", used" : ": Eigen's kernels instead");
}

OneThread::OneThread() : before_(omp_get_max_threads()) {
  [[maybe_unused]] static const bool once = [] {
    openblas_set_num_threads(1);
    return true;
  }();
  omp_set_num_threads(1);
}

OneThread::~OneThread() { omp_set_num_threads(before_); }

}  // namespace crumble::blas

// Which kernels multiply and factor dense matrices in this process: those of OpenBLAS or Eigen's own.
//
// OpenBLAS picks its kernel when it is loaded, by the processor it finds; Eigen's are compiled for the level of the
// build. OpenBLAS is the faster where both use registers of 32 bytes (AVX2) or its own are the wider. It is not where
// it does not know the processor and falls back to SSE (0.3.21 on many newer ones), nor, for the Cholesky factors that
// are most of the work, against Eigen compiled for AVX-512 (NOTEBOOK.md of common/hydro has the figures). The choice
// follows from the name of the kernel and the level of the build alone: a measurement at the start of each run would
// change the last bits of results from run to run.
#pragma once

#include <string>
#include <string_view>

namespace crumble::blas {

enum class Kernels { eigen, openblas };

// The rule. core: as openblas_get_corename() tells it; eigen_bytes: of a register, 0 without vectorisation.
Kernels kernels_for(std::string_view core, int eigen_bytes);

// What this process takes; decided once. OpenBLAS runs on one thread from then on: threads are ours.
Kernels kernels();

// "OpenBLAS 0.3.21, core Zen, used", or "OpenBLAS 0.3.21, core Prescott: Eigen's kernels instead".
std::string description();

// While it lives OpenBLAS uses the calling thread alone, whichever of its variants (pthread, OpenMP, serial) is
// installed: the one with OpenMP asks OpenMP how many threads it may take at every call.
class OneThread {
 public:
  OneThread();
  ~OneThread();
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  int before_;
};

}  // namespace crumble::blas

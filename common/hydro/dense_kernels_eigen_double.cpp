#include "common/hydro/dense_kernels_eigen.hpp"

namespace crumble::dense {

template struct EigenKernels<double>;

}  // namespace crumble::dense

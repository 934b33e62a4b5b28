#include "common/hydro/dense_kernels_eigen.hpp"

namespace crumble::dense {

template struct EigenKernels<float>;

}  // namespace crumble::dense

#include "common/numerics/eigen_kernels.hpp"

#ifdef CRUMBLE_EIGEN_KERNELS
CRUMBLE_EIGEN_KERNELS(template struct, double)
template class Eigen::ColPivHouseholderQR<Eigen::MatrixXd>;
#endif

// Some tests exist in two sizes: that of CI, and with CRUMBLE_TEST_LONG=1 that of pipeline/verify/long_tests.sh.
#pragma once

#include <cstdlib>

namespace crumble {

inline bool long_version() { return std::getenv("CRUMBLE_TEST_LONG") != nullptr; }

}  // namespace crumble

#include <fmt/format.h>

#include <algorithm>
#include <ostream>

#include "common/io/checker.hpp"
#include "common/io/file_errors.hpp"
#include "common/tool/verbs.hpp"

namespace crumble::tool {

// All files are looked at, whatever is wrong with the first; the exit code is that of the worst.
int check(const CheckOptions& options, std::ostream& out) {
  constexpr int valid = 0, invalid = 1, not_opened = 2;
  int worst = valid;
  for (const std::string& file : options.files) {
    try {
      const std::vector<Violation> violations = check_file(file);
      for (const Violation& v : violations) out << file << ": " << v.text() << "\n";
      if (violations.empty()) out << file << ": valid\n";
      worst = std::max(worst, violations.empty() ? valid : invalid);
    } catch (const OpenError& error) {
      out << error.what() << "\n";
      worst = std::max(worst, not_opened);
    }
  }
  return worst;
}

}  // namespace crumble::tool

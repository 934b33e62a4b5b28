#include <ostream>

#include "common/io/schema.hpp"
#include "common/tool/verbs.hpp"

namespace crumble::tool {

int schema(std::ostream& out) {
  out << schema_page();
  return 0;
}

}  // namespace crumble::tool

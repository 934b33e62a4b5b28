// Rows of tables and their changes.
#include "tests/fuzz/mutation.hpp"

namespace crumble::fuzz {

std::string mutated_table(const std::string& text, Random& random) {
  static const std::vector<std::string> rows{
      "x,y,z",
      "x;y;z;radius",
      "x\ty\tz\tdiameter",
      "20,0,0",
      "0,20,0",
      "1,5;2,5;3",
      "2\nProperties=species:S:1:pos:R:3:radius:R:1",
      "A 20 0 0",
      "A 0 0 20 10",
      "1,234;5;6",
      "# words",
      "\"a\",\"b\"",
      "t [s], dux/dx [1/s], dux/dy [1/s], dux/dz [1/s], "
      "duy/dx [1/s], duy/dy [1/s], duy/dz [1/s], duz/dx [1/s], duz/dy [1/s], duz/dz [1/s]",
      "0,1,0,0,0,-1,0,0,0,0",
      "0.1,1,0,0,0,-1,0,0,0,0",
      "0.2,0,2,0,0,0,0,0,0,0"};
  return mutated_lines(text, random, 0, [&] { return one_of(random, rows); });
}

}  // namespace crumble::fuzz

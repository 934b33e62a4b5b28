// "0.2,0.4" as numbers.
#pragma once

#include <string_view>
#include <vector>

namespace crumble {

// Numbers between commas, blanks around them allowed. Throws std::invalid_argument naming what is not a number.
std::vector<double> number_list(std::string_view list);

}  // namespace crumble

// Words of a line.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crumble::text {

using Words = std::vector<std::string_view>;

std::string_view trimmed(std::string_view s);  // without blanks at both ends
std::string lower(std::string_view s);
std::string quoted(std::string_view s);  // 'as it stands', long ones cut

Words split(std::string_view s, char separator);  // words are trimmed
Words split_at_blanks(std::string_view s);

// All of a word as a number, in any spelling that C++ and spreadsheets write ("1", "+1", "1e-3", "nan").
std::optional<double> to_number(std::string_view word);

}  // namespace crumble::text

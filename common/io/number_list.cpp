#include "common/io/number_list.hpp"

#include <fmt/core.h>

#include <charconv>
#include <stdexcept>

namespace crumble {

namespace {

double number(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  const std::string_view bare =
      first == text.npos ? std::string_view() : text.substr(first, text.find_last_not_of(' ') + 1 - first);
  double value = 0;
  const auto [end, problem] = std::from_chars(bare.data(), bare.data() + bare.size(), value);
  if (problem != std::errc() || end != bare.data() + bare.size())
    throw std::invalid_argument(fmt::format("'{}' is not a number", text));
  return value;
}

}  // namespace

std::vector<double> number_list(std::string_view list) {
  std::vector<double> values;
  for (std::size_t start = 0, comma = 0; comma != list.npos; start = comma + 1) {
    comma = list.find(',', start);
    values.push_back(number(list.substr(start, comma - start)));
  }
  return values;
}

}  // namespace crumble

#include "common/text/words.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace crumble::text {

namespace {
bool blank(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }
}  // namespace

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && blank(s.front())) s.remove_prefix(1);
  while (!s.empty() && blank(s.back())) s.remove_suffix(1);
  return s;
}

std::string lower(std::string_view s) {
  std::string out(s);
  std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return std::tolower(c); });
  return out;
}

std::string quoted(std::string_view s) {
  constexpr std::size_t longest = 40;
  return "'" + std::string(s.substr(0, longest)) + (s.size() > longest ? "...'" : "'");
}

Words split(std::string_view s, char separator) {
  Words words;
  for (std::size_t end; (end = s.find(separator)) != s.npos; s.remove_prefix(end + 1))
    words.push_back(trimmed(s.substr(0, end)));
  words.push_back(trimmed(s));
  return words;
}

Words split_at_blanks(std::string_view s) {
  Words words;
  for (s = trimmed(s); !s.empty(); s = trimmed(s)) {
    const auto end = static_cast<std::size_t>(std::find_if(s.begin(), s.end(), blank) - s.begin());
    words.push_back(s.substr(0, end));
    s.remove_prefix(end);
  }
  return words;
}

std::optional<double> to_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (problem != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

}  // namespace crumble::text

#include "tests/fuzz/mutation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "common/io/errors.hpp"

namespace crumble::fuzz {

std::size_t below(Random& random, std::size_t bound) { return random() % bound; }

std::string any_number(Random& random) {
  static const std::vector<std::string> known{
      "0",    "1",   "-1",    "2",    "3",     "4",      "8",    "0.5",        "1e-9",        "1e-30",
      "1e30", "nan", "inf",   "-inf", "1e308", "5e-324", "-0.0", "2147483647", "-2147483648", "9223372036854775807",
      "1e-8", "255", "65536", "1e-7", "1e-6",  "1e5",    "1e9",  "100",        "0.1",         "-9223372036854775808"};
  if (below(random, 3) > 0) return one_of(random, known);
  if (below(random, 2)) return std::to_string(below(random, 40));
  const double mantissa = 1 + static_cast<double>(below(random, 9000)) / 1000;
  return fmt::format("{}{:.4g}", below(random, 4) ? "" : "-",
                     mantissa * std::pow(10, static_cast<double>(below(random, 40)) - 20));
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines(1);
  for (const char c : text)
    if (c == '\n')
      lines.emplace_back();
    else
      lines.back().push_back(c);
  if (lines.back().empty()) lines.pop_back();
  return lines;
}

std::string text_of(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

namespace {

bool of_a_number(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-' || c == '+'; }

// Puts another number in the place of one.
void change_number(std::string& line, Random& random) {
  std::vector<std::size_t> begins;
  for (std::size_t k = 0; k < line.size(); ++k)
    if ((std::isdigit(static_cast<unsigned char>(line[k])) || line[k] == '-') && (k == 0 || !of_a_number(line[k - 1])))
      begins.push_back(k);
  if (begins.empty()) return;
  const std::size_t begin = one_of(random, begins);
  std::size_t end = begin;
  while (end < line.size() && of_a_number(line[end])) ++end;
  line.replace(begin, end - begin, any_number(random));
}

}  // namespace

std::string mutated_lines(const std::string& text, Random& random, std::size_t fixed,
                          const std::function<std::string()>& fresh) {
  std::vector<std::string> lines = lines_of(text);
  for (std::size_t changes = 1 + below(random, 3); changes > 0; --changes) {
    const std::size_t free = lines.size() > fixed ? lines.size() - fixed : 0;
    const auto at = [&] { return lines.begin() + static_cast<std::ptrdiff_t>(fixed + below(random, free)); };
    const auto gap =
        lines.begin() + static_cast<std::ptrdiff_t>(std::min(lines.size(), fixed + below(random, free + 1)));
    const std::size_t what = below(random, 10);
    if (what < 4 || free == 0)
      lines.insert(gap, fresh());
    else if (what < 5)
      lines.erase(at());
    else if (what < 6)
      std::swap(*at(), *at());
    else if (what < 7)
      lines.insert(gap, std::string(*at()));
    else
      change_number(*at(), random);
  }
  return text_of(lines);
}

std::string outcome(const std::function<std::string()>& work) {
  try {
    return work();
  } catch (const InputError& error) {
    return std::string("refused: ") + error.what();
  } catch (const FormatError& error) {
    return std::string("refused: ") + error.what();
  }
}

}  // namespace crumble::fuzz

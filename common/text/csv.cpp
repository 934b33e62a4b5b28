#include "common/text/csv.hpp"

#include <algorithm>

namespace crumble::text {

Csv::Csv(std::string_view text, const std::string& file, const std::string& expected) : lines_(text, file) {
  if (!find_words()) throw lines_.error("expected a header " + expected + ", found no text");
  names_ = words_;
  if (names_.size() == 1 && names_[0].find_first_of(";\t") != names_[0].npos)
    throw lines_.error("expected a header " + expected + ", found " + quoted(names_[0]) +
                       " (separate columns by commas, and write numbers with points)");
}

bool Csv::next() {
  if (!find_words()) return false;
  if (words_.size() == names_.size()) return true;
  const bool decimal_commas = words_.size() == 2 * names_.size();
  throw lines_.error("expected " + std::to_string(names_.size()) + " values as in the header, found " +
                     std::to_string(words_.size()) +
                     (decimal_commas ? " (write numbers with points, not commas)" : ""));
}

double Csv::number(std::size_t column) const { return lines_.number_of(words_[column], std::string(names_[column])); }

bool Csv::find_words() {
  while (const auto line = lines_.next()) {
    words_ = split(line->substr(0, line->find('#')), ',');
    for (std::string_view& word : words_)
      if (word.size() >= 2 && word.front() == '"' && word.back() == '"')
        word = trimmed(word.substr(1, word.size() - 2));
    if (!std::all_of(words_.begin(), words_.end(), [](std::string_view word) { return word.empty(); })) return true;
  }
  return false;
}

}  // namespace crumble::text

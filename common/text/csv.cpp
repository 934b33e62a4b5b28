#include "common/text/csv.hpp"

#include <algorithm>
#include <cctype>

namespace crumble::text {

namespace {

// A number with a decimal comma as one with a point, if it is one.
std::string with_point(std::string_view word) {
  std::string text(word);
  if (const auto comma = text.find(','); comma != text.npos) text[comma] = '.';
  return text;
}

// "-1,234", which is a thousand and more to some and 1.234 to others. No thousand begins with a zero.
bool may_be_thousands(std::string_view word) {
  if (word.starts_with('+') || word.starts_with('-')) word.remove_prefix(1);
  const auto comma = word.find(',');
  return comma >= 1 && comma <= 3 && word.size() == comma + 4 && word[0] != '0' &&
         std::all_of(word.begin(), word.end(), [](unsigned char c) { return c == ',' || std::isdigit(c) != 0; });
}

}  // namespace

Csv::Csv(std::string_view text, const std::string& file, const std::string& expected) : lines_(text, file) {
  std::optional<std::string_view> header;
  while ((header = lines_.next()) && !take(*header)) {
  }
  if (!header) throw lines_.error("expected a header " + expected + ", found no text");
  for (const char other : {';', '\t'})
    if (separator_ == ',' && header->substr(0, header->find('#')).find(other) != header->npos) separator_ = other;
  take(*header);
  names_ = words_;
  if (separator_ != ',') find_decimal_sign();
}

void Csv::find_decimal_sign() {
  Csv ahead = *this;
  std::string comma, point;  // a number with each, and where
  bool certain = false;
  while (ahead.find_words())
    for (const std::string_view word : ahead.words_) {
      const bool has_comma = word.find(',') != word.npos;
      if (!to_number(with_point(word)) || (!has_comma && word.find('.') == word.npos)) continue;
      std::string& first = has_comma ? comma : point;
      if (first.empty()) first = quoted(word) + " on line " + std::to_string(ahead.lines_.number());
      certain = certain || (has_comma && !may_be_thousands(word));
    }
  if (comma.empty()) return;
  if (!point.empty())
    throw TextError(lines_.file() + ": " + comma + " has a comma and " + point +
                    " a point: write all numbers with the same decimal sign, and without signs between thousands");
  if (!certain)
    throw TextError(lines_.file() + ": " + comma +
                    " may be a thousand or have a decimal comma, and no other number says which: write numbers with "
                    "points");
  decimal_comma_ = true;
}

bool Csv::next() {
  if (!find_words()) return false;
  if (words_.size() == names_.size()) return true;
  const bool decimal_commas = separator_ == ',' && words_.size() == 2 * names_.size();
  throw lines_.error("expected " + std::to_string(names_.size()) + " values as in the header, found " +
                     std::to_string(words_.size()) +
                     (decimal_commas ? " (write numbers with points, or separate columns by semicolons)" : ""));
}

double Csv::number(std::size_t column, const std::string& name) const {
  const std::string_view word = words_[column];
  if (decimal_comma_)
    if (const std::string text = with_point(word); to_number(text)) return lines_.number_of(text, name);
  return lines_.number_of(word, name);
}

bool Csv::take(std::string_view line) {
  words_ = split(line.substr(0, line.find('#')), separator_);
  for (std::string_view& word : words_)
    if (word.size() >= 2 && word.front() == '"' && word.back() == '"') word = trimmed(word.substr(1, word.size() - 2));
  return !std::all_of(words_.begin(), words_.end(), [](std::string_view word) { return word.empty(); });
}

bool Csv::find_words() {
  while (const auto line = lines_.next())
    if (take(*line)) return true;
  return false;
}

}  // namespace crumble::text

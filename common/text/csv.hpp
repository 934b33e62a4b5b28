// Tables as people and spreadsheets write them: values with commas, semicolons or tabs between them.
#pragma once

#include <string>
#include <string_view>

#include "common/text/lines.hpp"
#include "common/text/words.hpp"

namespace crumble::text {

// A header of names, then rows of as many words. # begins a comment; lines without a word are passed over; words may
// stand in quotes, but hold no separator; lines end with LF or CRLF. The separator is a semicolon or else a tab if the
// header has one, else a comma. Where it is no comma, numbers may have decimal commas, as spreadsheets of half the
// world write them: a table with both signs, or whose commas may all stand between thousands, is refused. Throws
// TextError that names file and line.
class Csv {
 public:
  // Reads as far as the header. expected: what its columns should be, for messages.
  Csv(std::string_view text, const std::string& file, const std::string& expected);

  const Words& names() const { return names_; }
  // The next row, false after the last; throws unless it has as many words as the header.
  bool next();
  std::string_view operator[](std::size_t column) const { return words_[column]; }
  // Finite, else TextError that calls it `name`, or as the header does.
  double number(std::size_t column, const std::string& name) const;
  double number(std::size_t column) const { return number(column, std::string(names_[column])); }
  const Lines& lines() const { return lines_; }

 private:
  bool take(std::string_view line);  // into words_; false if it has none
  bool find_words();
  void find_decimal_sign();

  Lines lines_;
  char separator_ = ',';
  bool decimal_comma_ = false;
  Words names_, words_;
};

}  // namespace crumble::text

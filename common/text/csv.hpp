// Comma-separated values as people and spreadsheets write them.
#pragma once

#include <string>
#include <string_view>

#include "common/text/lines.hpp"
#include "common/text/words.hpp"

namespace crumble::text {

// A header of names, then rows of as many words. # begins a comment; lines without a word are passed over; words may
// stand in quotes, but hold no comma; lines end with LF or CRLF. Throws TextError that names file and line.
class Csv {
 public:
  // Reads as far as the header. expected: what its columns should be, for messages.
  Csv(std::string_view text, const std::string& file, const std::string& expected);

  const Words& names() const { return names_; }
  // The next row, false after the last; throws unless it has as many words as the header.
  bool next();
  std::string_view operator[](std::size_t column) const { return words_[column]; }
  double number(std::size_t column) const;  // finite, else TextError
  const Lines& lines() const { return lines_; }

 private:
  bool find_words();

  Lines lines_;
  Words names_, words_;
};

}  // namespace crumble::text

// The lines of a text with their numbers, for messages.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace crumble::text {

// What is wrong with a text, beginning with file and line: "points.csv:14: y: expected a number, found '1,5'".
struct TextError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The file cannot be read at all.
struct UnreadableError : TextError {
  using TextError::TextError;
};

// All of a file. Throws UnreadableError: a device is not read, as it may never end.
std::string whole_file(const std::string& file);

class Lines {
 public:
  // file: as messages call it. Throws TextError if the text is not of single bytes (UTF-16, a binary file). A byte
  // order mark is passed over.
  Lines(std::string_view text, std::string file);

  std::optional<std::string_view> next();
  int number() const { return number_; }  // of the last line, from 1
  const std::string& file() const { return file_; }
  bool only_blank_left() const;

  TextError error(const std::string& what) const;  // of this line

  // A word of this line as a finite number; `name` says whose, in the message. Throws TextError.
  double number_of(std::string_view word, const std::string& name) const;

 private:
  std::string_view rest_;
  std::string file_;
  int number_ = 0;
};

}  // namespace crumble::text
